#include "bench/nonnegative_least_squares.hpp"

#include <algorithm>
#include <vector>

#include <Eigen/QR>

namespace flexspline::data {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Least squares over the free columns, zero elsewhere.
VectorXd solve_free(const MatrixXd& a, const VectorXd& b, const std::vector<Index>& free) {
  const VectorXd part = a(Eigen::all, free).colPivHouseholderQr().solve(b);
  VectorXd x = VectorXd::Zero(a.cols());
  x(free) = part;
  return x;
}

/// Goes from x towards target until the first free entry reaches zero, and binds it.
VectorXd step_to_boundary(const VectorXd& x, const VectorXd& target, std::vector<Index>& free) {
  double step = 1.0;
  for (const Index i : free) {
    if (target[i] <= 0.0) step = std::min(step, x[i] / (x[i] - target[i]));
  }
  VectorXd next = x + step * (target - x);
  const double zero = 1e-13 * std::max(1.0, next.maxCoeff());
  std::erase_if(free, [&](Index i) { return next[i] <= zero && target[i] <= 0.0; });
  for (Index i = 0; i < next.size(); ++i) {
    if (std::find(free.begin(), free.end(), i) == free.end()) next[i] = 0.0;
  }
  return next;
}

/// The bound entry whose release lowers the cost fastest, or -1.
Index steepest_bound(const VectorXd& descent, const std::vector<Index>& free, double tolerance) {
  Index best = -1;
  for (Index i = 0; i < descent.size(); ++i) {
    const bool bound = std::find(free.begin(), free.end(), i) == free.end();
    if (bound && descent[i] > tolerance && (best < 0 || descent[i] > descent[best])) best = i;
  }
  return best;
}

bool positive(const VectorXd& x, const std::vector<Index>& free) {
  return std::all_of(free.begin(), free.end(), [&](Index i) { return x[i] > 0.0; });
}

}  // namespace

VectorXd nonnegative_least_squares(const MatrixXd& a, const VectorXd& b) {
  VectorXd x = VectorXd::Zero(a.cols());
  std::vector<Index> free;
  const double tolerance = 1e-12 * a.cwiseAbs().maxCoeff() * b.cwiseAbs().sum();
  for (Index round = 0; round < 10 * a.cols(); ++round) {
    const Index entering = steepest_bound(a.transpose() * (b - a * x), free, tolerance);
    if (entering < 0) break;
    free.push_back(entering);
    VectorXd target = solve_free(a, b, free);
    while (!positive(target, free)) {
      x = step_to_boundary(x, target, free);
      target = solve_free(a, b, free);
    }
    x = target;
  }
  return x;
}

}  // namespace flexspline::data
