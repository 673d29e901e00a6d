#pragma once

#include "torque_driven/driven_fit.hpp"

namespace flexspline::estimators {

/// What was found in SI units, with covariance (residuals taken as white, their size as found),
/// bands and a verdict on identifiability.
/// Errors: numerics, where the fit failed or left no law that could be made.
Result<Estimate> driven_estimate(const DrivenProblem& problem, const DrivenFit& fit, bool linear,
                                 std::size_t threads);

}  // namespace flexspline::estimators
