#include "flexspline/estimators/bounded_least_squares.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
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

// min y'Ny/2 - y't over y >= 0 but for the free entries, which never leave the passive set.
class ActiveSet {
 public:
  ActiveSet(const Eigen::MatrixXd& normal, Eigen::VectorXd target, std::vector<bool> free)
      : normal_(normal),
        target_(std::move(target)),
        free_(std::move(free)),
        passive_(free_),
        y_(Eigen::VectorXd::Zero(target_.size())) {}

  // To the minimum over the passive set, giving up the entries that reach zero on the way.
  void descend() {
    for (;;) {
      const auto list = indices(passive_);
      if (list.empty()) return;
      const Eigen::VectorXd trial = solve_passive(normal_, target_, list);
      const double step = admissible_step(list, trial);
      y_(list) += step * (trial - Eigen::VectorXd(y_(list)));
      if (step >= 1.0) return;
      const double zero = 1e-14 * y_.cwiseAbs().maxCoeff();
      for (Eigen::Index k : list) {
        if (is_free(k) || y_[k] > zero) continue;
        y_[k] = 0.0;
        passive_[static_cast<std::size_t>(k)] = false;
      }
    }
  }

  // Takes in the entry at zero that promises most; false where none does.
  bool take_in() {
    const double tolerance = 1e-12 * target_.cwiseAbs().maxCoeff();
    const Eigen::VectorXd gradient = target_ - normal_ * y_;
    Eigen::Index best = -1;
    for (Eigen::Index k = 0; k < gradient.size(); ++k) {
      if (passive_[static_cast<std::size_t>(k)] || !(gradient[k] > tolerance)) continue;
      if (best < 0 || gradient[k] > gradient[best]) best = k;
    }
    if (best >= 0) passive_[static_cast<std::size_t>(best)] = true;
    return best >= 0;
  }

  const Eigen::VectorXd& solution() const { return y_; }

 private:
  bool is_free(Eigen::Index k) const { return free_[static_cast<std::size_t>(k)]; }

  double admissible_step(const std::vector<Eigen::Index>& list,
                         const Eigen::VectorXd& trial) const {
    double step = 1.0;
    for (std::size_t i = 0; i < list.size(); ++i) {
      const double z = trial[static_cast<Eigen::Index>(i)];
      const double y = y_[list[i]];
      if (!is_free(list[i]) && z <= 0.0) step = std::min(step, y / (y - z));
    }
    return step;
  }

  const Eigen::MatrixXd& normal_;
  Eigen::VectorXd target_;
  std::vector<bool> free_;
  std::vector<bool> passive_;
  Eigen::VectorXd y_;
};

}  // namespace

Eigen::VectorXd bounded_least_squares(const Eigen::MatrixXd& normal, const Eigen::VectorXd& c,
                                      const Eigen::VectorXd& lower) {
  // x = lower + y with y >= 0.
  const Eigen::VectorXd shift =
      lower.unaryExpr([](double l) { return std::isfinite(l) ? l : 0.0; });
  std::vector<bool> free;
  for (double l : lower) free.push_back(!std::isfinite(l));
  ActiveSet set(normal, c - normal * shift, std::move(free));
  for (Eigen::Index sweep = 0; sweep < 10 * c.size(); ++sweep) {
    set.descend();
    if (!set.take_in()) break;
  }
  return shift + set.solution();
}

}  // namespace flexspline::estimators
