#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "flexspline/core/error.hpp"

namespace flexspline::estimators {

/// Weighted columns that several fits share, with their part of the normal equations.
struct SharedColumns {
  explicit SharedColumns(Eigen::MatrixXd weighted);

  Eigen::MatrixXd columns;

  /// columns^T columns, computed when it is first asked for.
  const Eigen::MatrixXd& gram() const;

 private:
  mutable std::once_flag once_;
  mutable Eigen::MatrixXd gram_;
};

/// Rows of a separable problem that share their columns: target - [shared columns] b(index), all
/// weighted.
struct SeparableBlock {
  Eigen::MatrixXd columns;
  Eigen::VectorXd target;
  std::vector<Eigen::Index> index;  ///< position in b of each column, the shared ones first
  std::shared_ptr<const SharedColumns> shared = nullptr;
};

/// target - [shared columns] b, b in the order of the block's index.
Eigen::VectorXd residual_of(const SeparableBlock& block, const Eigen::VectorXd& b);

/// A parameter that enters non-linearly; held where its bounds are one.
struct ShapeBound {
  double start = 0.0;
  double lower = 0.0;
  double upper = 0.0;
};

/// Where a fit starts: the start of each shape, or the bound that it lies beyond.
std::vector<double> starts_of(const std::vector<ShapeBound>& shapes);

/// Step of a one-sided difference at q that stays in the bounds, 1e-4 of the range; 0 where a shape
/// is held.
double difference_step(const ShapeBound& bound, double q);

struct SeparableFit {
  std::vector<double> q;
  Eigen::VectorXd b;
  std::vector<Eigen::VectorXd> residual;  ///< by block, weighted: target - columns b
  double sum_of_squares = 0.0;
  int evaluations = 0;
};

/// min over q in its bounds and b >= lower of sum_blocks ||y(q) - X(q) b||^2 (Golub and Pereyra
/// 1973, with bounds on b). Blocks may come and go with q, b may not.
struct SeparableProblem {
  std::function<std::vector<SeparableBlock>(std::span<const double> q)> assemble;
  Eigen::VectorXd lower;  ///< of b; -infinity: free
  std::vector<ShapeBound> shapes;
  /// By how much a step of shape i changes the residual of a fit at its b, by block, where that is
  /// cheaper than X; empty of a block that stays. Not given: by assemble.
  std::function<std::vector<Eigen::VectorXd>(const SeparableFit& fit, std::size_t i, double step)>
      changes = nullptr;
};

/// b alone, at shapes given.
SeparableFit solve_linear(const SeparableProblem& problem, std::span<const double> q);

/// Shapes by Levenberg and Marquardt on the projected residual, its Jacobian after Kaufman (BIT 15,
/// 1975) by differences of 1e-4 of each shape's range; at most that many steps, and none after one
/// by which the sum of squares falls by no more than smallest_gain of itself. Local: from the start
/// given.
/// Errors: numerics where the start gives no numbers.
Result<SeparableFit> fit_separable(const SeparableProblem& problem, int most_steps,
                                   double smallest_gain = 1e-7);

}  // namespace flexspline::estimators
