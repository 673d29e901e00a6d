#pragma once

#include <Eigen/Core>

namespace flexspline::estimators {

/// argmin ||A x - b|| subject to x >= lower, from the normal equations N = A'A, c = A'b, by the
/// active-set method of Lawson and Hanson (1974). Columns of -infinity are free.
Eigen::VectorXd bounded_least_squares(const Eigen::MatrixXd& normal, const Eigen::VectorXd& c,
                                      const Eigen::VectorXd& lower);

}  // namespace flexspline::estimators
