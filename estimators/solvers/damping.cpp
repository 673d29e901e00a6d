#include "solvers/damping.hpp"

#include <algorithm>

namespace flexspline::estimators {
namespace {

constexpr double kFactor = 3.0;
constexpr double kLeast = 1e-16;
constexpr double kMost = 1e16;

}  // namespace

Eigen::VectorXd Damping::at(const Linearisation& now, const Eigen::VectorXd& x) {
  const Eigen::VectorXd columns = now.jacobian.colwise().squaredNorm();
  if (least_.size() == 0) {
    least_ = floor_ * (1.0 + columns.array().sqrt()).square();
  } else if (x != x_) {
    learn(now, x - x_);
  }
  last_ = now;
  x_ = x;
  return value_ * columns.cwiseMax(least_);
}

void Damping::learn(const Linearisation& now, const Eigen::VectorXd& step) {
  const double before = last_.residual.squaredNorm();
  const double foretold = before - (last_.residual + last_.jacobian * step).squaredNorm();
  const double fall = before - now.residual.squaredNorm();
  if (foretold > 0.0 && fall > 0.75 * foretold) {
    value_ = std::max(value_ / kFactor, kLeast);
  } else if (foretold <= 0.0 || fall < 0.25 * foretold) {
    value_ = std::min(value_ * kFactor, kMost);
  }
}

}  // namespace flexspline::estimators
