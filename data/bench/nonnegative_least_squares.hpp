#pragma once

#include <Eigen/Core>

namespace flexspline::data {

/// x >= 0 that minimises |A x - b|, by the active set of Lawson and Hanson (1974). For a few
/// columns: every step solves the free columns afresh by QR.
Eigen::VectorXd nonnegative_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

}  // namespace flexspline::data
