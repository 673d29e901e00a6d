#pragma once

#include <span>

#include "solvers/least_squares.hpp"

namespace flexspline::estimators {

struct ProfileSettings {
  double variance = 1.0;                ///< of the residuals
  double quantile = 1.959963984540054;  ///< of the standard normal or Student's law, two-sided
  double tolerance = 1e-7;  ///< of the ends, relative; not below the noise of the residuals
  SolverSettings solver{.function_tolerance = 1e-12, .parameter_tolerance = 1e-12};
};

/// Where the least cost at a held parameter has risen by variance quantile^2 / 2.
struct ProfileInterval {
  double lower = kNotComputed;
  double upper = kNotComputed;
  bool lower_open = false;  ///< the cost does not rise so far down to the bound, or to infinity
  bool upper_open = false;
  long evaluations = 0;  ///< of residual blocks
};

/// Interval of parameter k by profile likelihood (Bates and Watts 1988, ch. 6): that of Student's
/// law where the model is linear, and honest where it bends or a bound is near. `covariance`, of
/// all parameters at the minimum p, only says where to look first.
/// Errors: numerics, where a held fit cannot be made, or one is better than p.
Result<ProfileInterval> profile_interval(const LeastSquaresProblem& problem,
                                         std::span<const BoundedParameter> parameters,
                                         std::span<const double> p,
                                         const Eigen::MatrixXd& covariance, std::size_t k,
                                         const ProfileSettings& settings);

}  // namespace flexspline::estimators
