#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "flexspline/core/column_products.hpp"
#include "flexspline/estimators/bounded_least_squares.hpp"
#include "flexspline/estimators/separable.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kDifference = 1e-4;  // of a shape's range
constexpr double kMostDamping = 1e7;
constexpr double kLeastDamping = 1e-6;

/// a^T b, or of it what lies on and below the diagonal.
Eigen::MatrixXd products(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, bool lower) {
  static const ColumnProducts multiply = column_products(best_instruction_set());
  Eigen::MatrixXd product(a.cols(), b.cols());
  multiply({a.data(), a.cols()}, {b.data(), b.cols()}, a.rows(), lower, product.data());
  return product;
}

Eigen::MatrixXd gram_of(const Eigen::MatrixXd& columns) {
  return products(columns, columns, true).selfadjointView<Eigen::Lower>();
}

Eigen::MatrixXd gram_of(const SeparableBlock& block) {
  if (block.shared == nullptr) return gram_of(block.columns);
  const Eigen::Index shared = block.shared->columns.cols();
  const Eigen::Index own = block.columns.cols();
  Eigen::MatrixXd gram(shared + own, shared + own);
  gram.topLeftCorner(shared, shared) = block.shared->gram();
  gram.topRightCorner(shared, own) = products(block.shared->columns, block.columns, false);
  gram.bottomLeftCorner(own, shared) = gram.topRightCorner(shared, own).transpose();
  gram.bottomRightCorner(own, own) = gram_of(block.columns);
  return gram;
}

Eigen::VectorXd transposed_times(const SeparableBlock& block, const Eigen::VectorXd& y) {
  Eigen::VectorXd product(static_cast<Eigen::Index>(block.index.size()));
  if (block.shared != nullptr) {
    product.head(block.shared->columns.cols()) = block.shared->columns.transpose() * y;
  }
  product.tail(block.columns.cols()) = block.columns.transpose() * y;
  return product;
}

Eigen::VectorXd times(const SeparableBlock& block, const Eigen::VectorXd& b) {
  Eigen::VectorXd product = block.columns * b.tail(block.columns.cols());
  if (block.shared != nullptr) {
    product += block.shared->columns * b.head(block.shared->columns.cols());
  }
  return product;
}

/// N b = X^T target of all blocks together.
struct NormalEquations {
  Eigen::MatrixXd normal;
  Eigen::VectorXd right;
};

NormalEquations normal_equations(const std::vector<SeparableBlock>& blocks, Eigen::Index count) {
  NormalEquations n{Eigen::MatrixXd::Zero(count, count), Eigen::VectorXd::Zero(count)};
  for (const SeparableBlock& block : blocks) {
    n.normal(block.index, block.index) += gram_of(block);
    n.right(block.index) += transposed_times(block, block.target);
  }
  return n;
}

// Column scaling keeps the normal equations of splines well conditioned.
Eigen::VectorXd scale_of(const Eigen::MatrixXd& normal) {
  return normal.diagonal().unaryExpr(
      [](double d) { return d > 0.0 && std::isfinite(d) ? 1.0 / std::sqrt(d) : 0.0; });
}

Eigen::MatrixXd scaled(const Eigen::MatrixXd& normal, const Eigen::VectorXd& scale) {
  Eigen::MatrixXd result = scale.asDiagonal() * normal * scale.asDiagonal();
  result.diagonal().array() += 1e-12;
  return result;
}

Eigen::VectorXd coefficients(const NormalEquations& n, const Eigen::VectorXd& lower) {
  const Eigen::VectorXd scale = scale_of(n.normal);
  // In scaled parameters; a column of zeros stays at its bound.
  Eigen::VectorXd bound = lower;
  for (Eigen::Index i = 0; i < lower.size(); ++i) {
    if (std::isfinite(lower[i])) bound[i] = scale[i] > 0.0 ? lower[i] / scale[i] : 0.0;
  }
  const Eigen::VectorXd b =
      bounded_least_squares(scaled(n.normal, scale), scale.cwiseProduct(n.right), bound);
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

/// A fit and what it was made of.
struct Point {
  SeparableFit fit;
  std::vector<SeparableBlock> blocks;
  Eigen::MatrixXd normal;
};

Point point_at(const SeparableProblem& problem, std::span<const double> q) {
  Point point;
  point.fit.q.assign(q.begin(), q.end());
  point.blocks = problem.assemble(q);
  NormalEquations n = normal_equations(point.blocks, problem.lower.size());
  point.fit.b = coefficients(n, problem.lower);
  point.normal = std::move(n.normal);
  for (const SeparableBlock& block : point.blocks) {
    point.fit.residual.push_back(residual_of(block, point.fit.b(block.index)));
    point.fit.sum_of_squares += point.fit.residual.back().squaredNorm();
  }
  point.fit.evaluations = 1;
  return point;
}

/// What the coefficients that are not on a bound take of a change of the residual.
class Projection {
 public:
  Projection(const Point& point, const Eigen::VectorXd& lower) : point_(point) {
    for (Eigen::Index i = 0; i < lower.size(); ++i) {
      if (point.fit.b[i] > lower[i] && point.normal(i, i) > 0.0) free_.push_back(i);
    }
    const Eigen::MatrixXd normal = point.normal(free_, free_);
    scale_ = scale_of(normal);
    solver_.compute(scaled(normal, scale_));
  }

  /// d - X (X^T X)^-1 X^T d over the free columns, block by block; an empty one is 0.
  void project(std::vector<Eigen::VectorXd>& change) const {
    Eigen::VectorXd right = Eigen::VectorXd::Zero(point_.fit.b.size());
    for (std::size_t k = 0; k < change.size(); ++k) {
      if (change[k].size() == 0) continue;
      const SeparableBlock& block = point_.blocks[k];
      right(block.index) += transposed_times(block, change[k]);
    }
    Eigen::VectorXd b = Eigen::VectorXd::Zero(right.size());
    b(free_) = scale_.cwiseProduct(solver_.solve(scale_.cwiseProduct(right(free_))));
    for (std::size_t k = 0; k < change.size(); ++k) {
      Eigen::VectorXd taken = times(point_.blocks[k], b(point_.blocks[k].index));
      if (change[k].size() == 0) {
        change[k] = -taken;
      } else {
        change[k] -= taken;
      }
    }
  }

 private:
  const Point& point_;
  std::vector<Eigen::Index> free_;
  Eigen::VectorXd scale_;
  Eigen::LDLT<Eigen::MatrixXd> solver_;
};

std::vector<Eigen::VectorXd> changes_of(const SeparableProblem& problem, const SeparableFit& fit,
                                        std::size_t i, double step) {
  if (problem.changes) return problem.changes(fit, i, step);
  std::vector<double> q = fit.q;
  q[i] += step;
  std::vector<Eigen::VectorXd> changes;
  for (const SeparableBlock& block : problem.assemble(q)) {
    const std::size_t k = changes.size();
    changes.push_back(residual_of(block, fit.b(block.index)) - fit.residual[k]);
  }
  return changes;
}

// The Jacobian of the projected residual after Kaufman (1975): the change of the residual at fixed
// b by one-sided differences that stay within the bounds, less what b takes of it. Its gradient is
// exact.
Eigen::MatrixXd jacobian(const SeparableProblem& problem, const Point& point, int& evaluations) {
  const Projection projection(point, problem.lower);
  const auto& [fit, blocks, normal] = point;
  Eigen::Index rows = 0;
  for (const auto& part : fit.residual) rows += part.size();
  Eigen::MatrixXd result(rows, static_cast<Eigen::Index>(fit.q.size()));
  for (std::size_t i = 0; i < fit.q.size(); ++i) {
    const ShapeBound& bound = problem.shapes[i];
    const double step = difference_step(bound, fit.q[i]);
    if (step == 0.0) {
      result.col(static_cast<Eigen::Index>(i)).setZero();
      continue;
    }
    auto change = changes_of(problem, fit, i, step);
    for (Eigen::VectorXd& part : change) part /= step;
    projection.project(change);
    result.col(static_cast<Eigen::Index>(i)) = stacked(change);
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

// The shapes that may move: not those on a bound that the gradient presses them against.
std::vector<Eigen::Index> movable(const SeparableProblem& problem, const std::vector<double>& q,
                                  const Eigen::VectorXd& gradient) {
  std::vector<Eigen::Index> list;
  for (std::size_t i = 0; i < q.size(); ++i) {
    const ShapeBound& bound = problem.shapes[i];
    const auto k = static_cast<Eigen::Index>(i);
    const bool held = bound.lower == bound.upper || (q[i] <= bound.lower && gradient[k] > 0.0) ||
                      (q[i] >= bound.upper && gradient[k] < 0.0);
    if (!held) list.push_back(k);
  }
  return list;
}

Eigen::VectorXd difference(const std::vector<double>& to, const std::vector<double>& from) {
  const auto n = static_cast<Eigen::Index>(to.size());
  return Eigen::Map<const Eigen::VectorXd>(to.data(), n) -
         Eigen::Map<const Eigen::VectorXd>(from.data(), n);
}

// Marquardt's damping, raised ever faster until the sum of squares falls; a step of which the
// Jacobian, whose gradient is exact, promises no fall that counts is not tried. False where none is
// left.
bool improve(const SeparableProblem& problem, Point& point, double& damping, double smallest_gain) {
  SeparableFit& fit = point.fit;
  const Eigen::MatrixXd j = jacobian(problem, point, fit.evaluations);
  const Eigen::MatrixXd hessian = j.transpose() * j;
  const Eigen::VectorXd gradient = j.transpose() * stacked(fit.residual);
  const Eigen::VectorXd diagonal = hessian.diagonal().cwiseMax(1e-12 * hessian.trace() + 1e-300);
  const auto free = movable(problem, fit.q, gradient);
  if (free.empty()) return false;
  for (double faster = 10.0; damping < kMostDamping; damping *= faster, faster *= 2.0) {
    Eigen::MatrixXd damped = hessian;
    damped.diagonal() += damping * diagonal;
    Eigen::VectorXd wanted = Eigen::VectorXd::Zero(gradient.size());
    wanted(free) = -damped(free, free).eval().ldlt().solve(gradient(free));
    const auto q = stepped(problem, fit.q, wanted);
    const Eigen::VectorXd step = difference(q, fit.q);
    const double promised = -step.dot(2.0 * gradient + hessian * step);
    if (!(promised > smallest_gain * fit.sum_of_squares)) continue;
    Point trial = point_at(problem, q);
    trial.fit.evaluations = ++fit.evaluations;
    if (!(trial.fit.sum_of_squares < fit.sum_of_squares)) continue;
    const bool worthwhile =
        fit.sum_of_squares - trial.fit.sum_of_squares > smallest_gain * fit.sum_of_squares;
    point = std::move(trial);
    damping = std::max(damping / 10.0, kLeastDamping);
    return worthwhile;
  }
  return false;
}

}  // namespace

std::vector<double> starts_of(const std::vector<ShapeBound>& shapes) {
  std::vector<double> q;
  for (const ShapeBound& shape : shapes) {
    q.push_back(std::clamp(shape.start, shape.lower, shape.upper));
  }
  return q;
}

double difference_step(const ShapeBound& bound, double q) {
  const double step = kDifference * (bound.upper - bound.lower);
  return q + step > bound.upper ? -step : step;
}

Eigen::VectorXd residual_of(const SeparableBlock& block, const Eigen::VectorXd& b) {
  return block.target - times(block, b);
}

SharedColumns::SharedColumns(Eigen::MatrixXd weighted) : columns(std::move(weighted)) {}

const Eigen::MatrixXd& SharedColumns::gram() const {
  std::call_once(once_, [this] { gram_ = gram_of(columns); });
  return gram_;
}

SeparableFit solve_linear(const SeparableProblem& problem, std::span<const double> q) {
  return point_at(problem, q).fit;
}

Result<SeparableFit> fit_separable(const SeparableProblem& problem, int most_steps,
                                   double smallest_gain) {
  const std::vector<double> q = starts_of(problem.shapes);
  Point point = point_at(problem, q);
  if (!std::isfinite(point.fit.sum_of_squares)) {
    return failure(ErrorCode::numerics, "the residuals are not finite at the start",
                   "check the recordings for extreme values");
  }
  double damping = 1e-3;
  for (int step = 0; step < most_steps && !q.empty(); ++step) {
    if (!improve(problem, point, damping, smallest_gain)) break;
  }
  return std::move(point.fit);
}

}  // namespace flexspline::estimators
