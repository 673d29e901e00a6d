#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "flexspline/estimators/bounded_least_squares.hpp"
#include "flexspline/estimators/separable.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kDifference = 1e-4;    // of a shape's range
constexpr double kSmallestGain = 1e-7;  // relative fall of the sum of squares that ends the fit
constexpr double kMostDamping = 1e7;

Eigen::MatrixXd gram_of(const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(columns.cols(), columns.cols());
  gram.selfadjointView<Eigen::Lower>().rankUpdate(columns.transpose());
  return gram.selfadjointView<Eigen::Lower>();
}

Eigen::MatrixXd gram_of(const SeparableBlock& block) {
  if (block.shared == nullptr) return gram_of(block.columns);
  const Eigen::Index shared = block.shared->columns.cols();
  const Eigen::Index own = block.columns.cols();
  Eigen::MatrixXd gram(shared + own, shared + own);
  gram.topLeftCorner(shared, shared) = block.shared->gram;
  gram.bottomLeftCorner(own, shared) = block.columns.transpose() * block.shared->columns;
  gram.topRightCorner(shared, own) = gram.bottomLeftCorner(own, shared).transpose();
  gram.bottomRightCorner(own, own) = gram_of(block.columns);
  return gram;
}

Eigen::VectorXd times_target(const SeparableBlock& block) {
  Eigen::VectorXd product(static_cast<Eigen::Index>(block.index.size()));
  if (block.shared != nullptr) {
    product.head(block.shared->columns.cols()) = block.shared->columns.transpose() * block.target;
  }
  product.tail(block.columns.cols()) = block.columns.transpose() * block.target;
  return product;
}

Eigen::VectorXd residual_of(const SeparableBlock& block, const Eigen::VectorXd& b) {
  Eigen::VectorXd residual = block.target - block.columns * b.tail(block.columns.cols());
  if (block.shared != nullptr) {
    residual -= block.shared->columns * b.head(block.shared->columns.cols());
  }
  return residual;
}

// Column scaling keeps the normal equations of splines well conditioned.
Eigen::VectorXd coefficients(const std::vector<SeparableBlock>& blocks,
                             const Eigen::VectorXd& lower) {
  const Eigen::Index k = lower.size();
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(k, k);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(k);
  for (const SeparableBlock& block : blocks) {
    normal(block.index, block.index) += gram_of(block);
    right(block.index) += times_target(block);
  }
  const Eigen::VectorXd scale = normal.diagonal().unaryExpr(
      [](double d) { return d > 0.0 && std::isfinite(d) ? 1.0 / std::sqrt(d) : 0.0; });
  Eigen::MatrixXd scaled = scale.asDiagonal() * normal * scale.asDiagonal();
  scaled.diagonal().array() += 1e-12;
  // In scaled parameters; a column of zeros stays at its bound.
  Eigen::VectorXd bound = lower;
  for (Eigen::Index i = 0; i < k; ++i) {
    if (std::isfinite(lower[i])) bound[i] = scale[i] > 0.0 ? lower[i] / scale[i] : 0.0;
  }
  const Eigen::VectorXd b = bounded_least_squares(scaled, scale.cwiseProduct(right), bound);
  return scale.cwiseProduct(b).cwiseMax(lower);
}

Eigen::VectorXd stacked(const std::vector<Eigen::VectorXd>& parts) {
  Eigen::Index n = 0;
  for (const auto& part : parts) n += part.size();
  Eigen::VectorXd all(n);
  n = 0;
  for (const auto& part : parts) {
    all.segment(n, part.size()) = part;
    n += part.size();
  }
  return all;
}

// The Jacobian of the projected residual by one-sided differences that stay within the bounds.
Eigen::MatrixXd jacobian(const SeparableProblem& problem, const SeparableFit& fit,
                         const Eigen::VectorXd& residual, int& evaluations) {
  Eigen::MatrixXd result(residual.size(), static_cast<Eigen::Index>(fit.q.size()));
  for (std::size_t i = 0; i < fit.q.size(); ++i) {
    const ShapeBound& bound = problem.shapes[i];
    double step = kDifference * (bound.upper - bound.lower);
    if (step == 0.0) {
      result.col(static_cast<Eigen::Index>(i)).setZero();
      continue;
    }
    if (fit.q[i] + step > bound.upper) step = -step;
    std::vector<double> q = fit.q;
    q[i] += step;
    result.col(static_cast<Eigen::Index>(i)) =
        (stacked(solve_linear(problem, q).residual) - residual) / step;
    ++evaluations;
  }
  return result;
}

std::vector<double> stepped(const SeparableProblem& problem, const std::vector<double>& q,
                            const Eigen::VectorXd& step) {
  std::vector<double> to = q;
  for (std::size_t i = 0; i < to.size(); ++i) {
    to[i] = std::clamp(q[i] + step[static_cast<Eigen::Index>(i)], problem.shapes[i].lower,
                       problem.shapes[i].upper);
  }
  return to;
}

// Marquardt's damping: raised until the sum of squares falls. False where it no longer does.
bool improve(const SeparableProblem& problem, SeparableFit& fit, double& damping) {
  const Eigen::VectorXd residual = stacked(fit.residual);
  const Eigen::MatrixXd j = jacobian(problem, fit, residual, fit.evaluations);
  Eigen::MatrixXd hessian = j.transpose() * j;
  const Eigen::VectorXd gradient = j.transpose() * residual;
  const Eigen::VectorXd diagonal = hessian.diagonal().cwiseMax(1e-12 * hessian.trace() + 1e-300);
  for (; damping < kMostDamping; damping *= 10.0) {
    Eigen::MatrixXd damped = hessian;
    damped.diagonal() += damping * diagonal;
    const auto q = stepped(problem, fit.q, -damped.ldlt().solve(gradient));
    SeparableFit trial = solve_linear(problem, q);
    trial.evaluations = fit.evaluations + 1;
    ++fit.evaluations;
    if (!(trial.sum_of_squares < fit.sum_of_squares)) continue;
    const bool worthwhile =
        fit.sum_of_squares - trial.sum_of_squares > kSmallestGain * fit.sum_of_squares;
    fit = std::move(trial);
    damping = std::max(damping / 10.0, 1e-9);
    return worthwhile;
  }
  return false;
}

}  // namespace

SharedColumns::SharedColumns(Eigen::MatrixXd weighted)
    : columns(std::move(weighted)), gram(gram_of(columns)) {}

SeparableFit solve_linear(const SeparableProblem& problem, std::span<const double> q) {
  SeparableFit fit;
  fit.q.assign(q.begin(), q.end());
  const std::vector<SeparableBlock> blocks = problem.assemble(q);
  fit.b = coefficients(blocks, problem.lower);
  for (const SeparableBlock& block : blocks) {
    const Eigen::VectorXd part = fit.b(block.index);
    fit.residual.push_back(residual_of(block, part));
    fit.sum_of_squares += fit.residual.back().squaredNorm();
  }
  fit.evaluations = 1;
  return fit;
}

Result<SeparableFit> fit_separable(const SeparableProblem& problem, int most_steps) {
  std::vector<double> q;
  for (const ShapeBound& shape : problem.shapes) {
    q.push_back(std::clamp(shape.start, shape.lower, shape.upper));
  }
  SeparableFit fit = solve_linear(problem, q);
  if (!std::isfinite(fit.sum_of_squares)) {
    return failure(ErrorCode::numerics, "the residuals are not finite at the start",
                   "check the recordings for extreme values");
  }
  double damping = 1e-3;
  for (int step = 0; step < most_steps && !q.empty(); ++step) {
    if (!improve(problem, fit, damping)) break;
  }
  return fit;
}

}  // namespace flexspline::estimators
