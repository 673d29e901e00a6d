#pragma once

#include <memory>
#include <span>
#include <vector>

#include "diagnosis/frame/baseline.hpp"
#include "flexspline/estimators/separable.hpp"

namespace flexspline::studies {

/// What shared_baseline() keeps.
std::shared_ptr<KeptBaselines> no_baselines_yet();

/// baseline_columns(), kept with the frame for the next who asks for the same motion and shape.
/// Thread-safe.
std::shared_ptr<const BaselineColumns> shared_baseline(const Frame& frame, Equation equation,
                                                       std::span<const double> shape);

/// Columns of the baseline's linear parameters on rows with a weight, weighted, then its prior, and
/// their bounds.
struct WeightedBaseline {
  Eigen::VectorXd lower;
  std::shared_ptr<const estimators::SharedColumns> columns;
};

/// The rows of one equation that a fit looks at, behind them those of the baseline's prior.
class WeightedRows {
 public:
  WeightedRows(const Eigen::ArrayXd& all, Eigen::Index prior);

  Eigen::Index size() const { return weight.size() + prior_; }
  /// Those rows of a signal, weighted; 0 in the prior's.
  Eigen::VectorXd of(const Eigen::ArrayXd& signal) const;

  std::vector<Eigen::Index> at;  ///< those with a weight
  Eigen::ArrayXd weight;         ///< theirs

 private:
  Eigen::Index prior_;
};

/// Those columns times linear parameters b.
Eigen::VectorXd weighted_sum(const Frame& frame, Equation equation, std::span<const double> shape,
                             const WeightedRows& rows, const Eigen::VectorXd& b);

/// The baseline's columns on some rows, kept like shared_baseline(). Thread-safe.
std::shared_ptr<const WeightedBaseline> weighted_baseline(const Frame& frame, Equation equation,
                                                          std::span<const double> shape,
                                                          const WeightedRows& rows);

}  // namespace flexspline::studies
