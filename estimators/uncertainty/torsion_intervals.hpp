#pragma once

#include "flexspline/estimators/uncertainty.hpp"
#include "torsion/trajectory_fit.hpp"
#include "uncertainty/intervals.hpp"

namespace flexspline::estimators {

/// Intervals of a fitted torsion law other than by its covariance. Where residuals are coloured or
/// the model misses something, the threshold of the profile grows as the covariance did, parameter
/// by parameter. The class of the laws and the terms that are free count as known.
/// Errors: those of intervals().
Result<Intervals> torsion_intervals(const TrajectoryFit& fit,
                                    const std::vector<PreparedRecord>& records,
                                    const UncertaintySettings& settings,
                                    const SolverSettings& solver,
                                    const IntegratorSettings& integrator);

}  // namespace flexspline::estimators
