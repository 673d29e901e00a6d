#pragma once

#include <vector>

#include "torsion/torsion_residuals.hpp"

namespace flexspline::estimators {

/// What noise of the measured torque, the input of eq. (3), adds to the middle of the sandwich: the
/// residual responds to it through the linearised equation delta phi' = decay delta phi + gain
/// delta tau; noise coloured within a record counts by its long-run variance.
/// Errors: numerics, where a record cannot be integrated.
Result<Eigen::MatrixXd> input_noise_covariance(const TorsionResiduals& problem,
                                               const std::vector<PreparedRecord>& records,
                                               const Linearisation& at, std::span<const double> p);

}  // namespace flexspline::estimators
