#pragma once

#include "flexspline/estimators/uncertainty.hpp"
#include "torsion/trajectory_fit.hpp"
#include "uncertainty/intervals.hpp"

namespace flexspline::estimators {

/// Draws of the parameters from their law within the bounds, where a coefficient of f or g^-1 lies
/// on its floor or within two standard deviations of it; empty elsewhere. The law is the normal one
/// about the minimum without bounds, to second order, cut off at them: the truth is known to
/// increase.
Eigen::MatrixXd draws_at_bounds(const TrajectoryFit& fit,
                                const std::vector<PreparedRecord>& records);

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
