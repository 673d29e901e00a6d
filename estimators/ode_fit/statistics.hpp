#pragma once

#include "ode_fit/layout.hpp"

namespace flexspline::estimators {

/// Puts what lies on a bound exactly there, and tells which does.
std::vector<bool> settle_on_bounds(const OdeLayout& layout, std::vector<double>& q);

/// The solution with residuals, covariance, intervals and a verdict, from the sensitivities of the
/// trajectory at it.
/// Errors: those of intervals by profile or bootstrap.
Result<OdeFit> with_statistics(const OdeLayout& layout, const OdeSolution& solution,
                               const OdeFitSettings& settings);

}  // namespace flexspline::estimators
