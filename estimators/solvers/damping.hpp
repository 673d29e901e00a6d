#pragma once

#include "solvers/least_squares.hpp"

namespace flexspline::estimators {

/// Levenberg and Marquardt's damping of J'J in the measure of Ceres,
/// lambda max(|J_k|^2, floor (1 + |J_k(start)|)^2), for a solver that has only a line search: alone
/// it takes the long steps of a near-singular J'J to plateaus that have no way back. lambda falls
/// where the linear model foretold the last step well, and rises where it did not.
class Damping {
 public:
  Damping(double start, double floor) : value_(start), floor_(floor) {}

  /// What to add to the diagonal of J'J; J and x in scaled parameters.
  Eigen::VectorXd at(const Linearisation& now, const Eigen::VectorXd& x);

 private:
  void learn(const Linearisation& now, const Eigen::VectorXd& step);

  double value_;
  double floor_;
  Eigen::VectorXd least_;
  Eigen::VectorXd x_;
  Linearisation last_;
};

}  // namespace flexspline::estimators
