#include "torque_driven/gauss_newton.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace flexspline::estimators {
namespace {

constexpr double kLeastDamping = 1e-12;
constexpr double kMostDamping = 1e12;

struct Step {
  Eigen::VectorXd change;
  double decrease = 0.0;  // of the cost, expected
};

std::optional<Step> damped_step(const NormalEquations& at, double damping) {
  Eigen::VectorXd scale = at.matrix.diagonal().cwiseSqrt();
  for (double& s : scale) s = s > 0.0 ? 1.0 / s : 1.0;
  Eigen::MatrixXd matrix = scale.asDiagonal() * at.matrix * scale.asDiagonal();
  const Eigen::VectorXd gradient = scale.asDiagonal() * at.gradient;
  matrix.diagonal().array() += damping;
  const Eigen::LDLT<Eigen::MatrixXd> factor(matrix);
  if (factor.info() != Eigen::Success || !factor.isPositive()) return std::nullopt;
  const Eigen::VectorXd scaled = factor.solve(-gradient);
  if (!scaled.allFinite()) return std::nullopt;
  const double decrease = 0.5 * (damping * scaled.squaredNorm() - gradient.dot(scaled));
  return Step{scale.asDiagonal() * scaled, decrease};
}

std::vector<double> moved(const std::vector<double>& p, const Eigen::VectorXd& change) {
  std::vector<double> result = p;
  for (std::size_t k = 0; k < p.size(); ++k) result[k] += change[static_cast<Eigen::Index>(k)];
  return result;
}

// Nielsen's rule: the better the linear model foretold the decrease, the less damping next.
double less_damping(double damping, double ratio) {
  const double factor = std::max(0.1, 1.0 - std::pow(2.0 * ratio - 1.0, 3));
  return std::max(kLeastDamping, damping * (ratio > 0.75 ? 0.03 : factor));
}

}  // namespace

GaussNewtonResult gauss_newton(std::vector<double> start, const NormalEvaluation& evaluate,
                               const GaussNewtonSettings& settings) {
  GaussNewtonResult result{.p = std::move(start), .at = {}, .evaluations = 1};
  auto first = evaluate(result.p);
  if (!first) {
    result.termination = Termination::failed;
    return result;
  }
  result.at = std::move(*first);
  double damping = settings.first_damping;
  double growth = 4.0;
  while (result.iterations < settings.max_iterations) {
    const auto step = damped_step(result.at, damping);
    if (step && step->decrease <= settings.decrease * result.at.cost) {
      result.termination = Termination::converged;
      return result;
    }
    ++result.iterations;
    double ratio = -1.0;
    if (step) {
      const auto trial_p = moved(result.p, step->change);
      auto trial = evaluate(trial_p);
      ++result.evaluations;
      if (trial) ratio = (result.at.cost - trial->cost) / step->decrease;
      if (ratio > 0.0) {
        result.p = trial_p;
        result.at = std::move(*trial);
        damping = less_damping(damping, ratio);
        growth = 4.0;
        continue;
      }
    }
    damping *= growth;
    growth *= 2.0;
    if (damping > kMostDamping) {
      result.termination = Termination::no_progress;
      return result;
    }
  }
  result.termination = Termination::iteration_limit;
  return result;
}

}  // namespace flexspline::estimators
