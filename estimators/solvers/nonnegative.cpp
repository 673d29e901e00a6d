#include "solvers/nonnegative.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Dense>

namespace flexspline::estimators {
namespace {

std::vector<Eigen::Index> indices(const std::vector<bool>& passive) {
  std::vector<Eigen::Index> list;
  for (std::size_t k = 0; k < passive.size(); ++k) {
    if (passive[k]) list.push_back(static_cast<Eigen::Index>(k));
  }
  return list;
}

// Least squares on the passive columns alone.
Eigen::VectorXd solve_passive(const Eigen::MatrixXd& normal, const Eigen::VectorXd& c,
                              const std::vector<Eigen::Index>& passive) {
  Eigen::MatrixXd n = normal(passive, passive);
  n.diagonal() *= 1.0 + 1e-13;  // keeps twin columns solvable
  return n.ldlt().solve(Eigen::VectorXd(c(passive)));
}

}  // namespace

Eigen::VectorXd bounded_least_squares(const Eigen::MatrixXd& normal, const Eigen::VectorXd& c,
                                      const Eigen::VectorXd& lower) {
  const Eigen::Index size = c.size();
  // x = lower + y with y >= 0; free columns have no lower bound and never leave the passive set.
  const Eigen::VectorXd shift = lower.unaryExpr([](double l) { return std::isfinite(l) ? l : 0.0; });
  const Eigen::VectorXd target = c - normal * shift;
  std::vector<bool> passive(static_cast<std::size_t>(size));
  auto is_free = [&](Eigen::Index k) { return !std::isfinite(lower[k]); };
  for (Eigen::Index k = 0; k < size; ++k) passive[static_cast<std::size_t>(k)] = is_free(k);

  Eigen::VectorXd y = Eigen::VectorXd::Zero(size);
  const double tolerance = 1e-12 * target.cwiseAbs().maxCoeff();
  for (Eigen::Index sweep = 0; sweep < 10 * size; ++sweep) {
    for (;;) {
      const auto list = indices(passive);
      if (list.empty()) break;
      const Eigen::VectorXd trial = solve_passive(normal, target, list);
      double step = 1.0;
      for (std::size_t i = 0; i < list.size(); ++i) {
        const double z = trial[static_cast<Eigen::Index>(i)];
        if (!is_free(list[i]) && z <= 0.0) step = std::min(step, y[list[i]] / (y[list[i]] - z));
      }
      for (std::size_t i = 0; i < list.size(); ++i) {
        y[list[i]] += step * (trial[static_cast<Eigen::Index>(i)] - y[list[i]]);
      }
      if (step >= 1.0) break;
      for (Eigen::Index k : list) {
        if (!is_free(k) && y[k] <= 1e-14 * y.cwiseAbs().maxCoeff()) {
          y[k] = 0.0;
          passive[static_cast<std::size_t>(k)] = false;
        }
      }
    }
    const Eigen::VectorXd gradient = target - normal * y;
    Eigen::Index best = -1;
    for (Eigen::Index k = 0; k < size; ++k) {
      if (!passive[static_cast<std::size_t>(k)] && gradient[k] > tolerance &&
          (best < 0 || gradient[k] > gradient[best])) {
        best = k;
      }
    }
    if (best < 0) break;
    passive[static_cast<std::size_t>(best)] = true;
  }
  return shift + y;
}

}  // namespace flexspline::estimators
