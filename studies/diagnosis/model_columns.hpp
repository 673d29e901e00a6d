#pragma once

#include <list>
#include <memory>
#include <optional>

#include "diagnosis/baseline.hpp"
#include "diagnosis/model.hpp"
#include "flexspline/estimators/separable.hpp"

namespace flexspline::studies {

/// One equation before weighting: columns of the baseline and of each cause side by side; none of a
/// cause that adds nothing to this equation.
struct EquationColumns {
  std::shared_ptr<const BaselineColumns> own;
  std::vector<std::shared_ptr<const Columns>> causes;
};

/// The columns of models on one frame. Those whose shapes did not change are not built again: a fit
/// changes one shape at a time, and candidates share their baseline.
class ModelColumns {
 public:
  ModelColumns(const Frame& frame, const Reference& reference)
      : frame_(frame), reference_(reference) {}

  /// The frame as the causes of the model that change it leave it; valid until the next call.
  const Frame& seen(const DriveModel& model);
  EquationColumns at(const DriveModel& model, Equation equation);
  /// Of each cause alone.
  std::vector<std::shared_ptr<const Columns>> causes_at(const DriveModel& model, Equation equation);

 private:
  struct Built {
    const CauseForm* form;
    Equation equation;
    std::vector<double> shape;
    std::shared_ptr<const Columns> columns;
  };
  std::shared_ptr<const Columns> columns_of(const Frame& seen, const ActiveCause& cause,
                                            Equation equation);

  const Frame& frame_;
  const Reference& reference_;
  std::optional<Frame> changed_;
  std::vector<std::vector<double>> changed_by_;  ///< shapes of the causes that changed it
  std::list<Built> built_;                       ///< on the frame seen last; the latest first
};

/// Shapes of the baseline in one equation.
std::span<const double> baseline_shape(const DriveModel& model, Equation equation);

/// What shared_baseline() keeps.
std::shared_ptr<KeptBaselines> no_baselines_yet();

/// baseline_columns(), kept with the frame for the next who asks for the same motion and shape.
/// Thread-safe.
std::shared_ptr<const BaselineColumns> shared_baseline(const Frame& frame, Equation equation,
                                                       std::span<const double> shape);

/// Columns of the baseline's linear parameters on rows with a weight, weighted, and their bounds.
struct WeightedBaseline {
  Eigen::VectorXd lower;
  std::shared_ptr<const estimators::SharedColumns> columns;
};

/// The rows of one equation that a fit looks at.
struct WeightedRows {
  explicit WeightedRows(const Eigen::ArrayXd& all);

  /// Those rows of a signal, weighted.
  Eigen::VectorXd of(const Eigen::ArrayXd& signal) const;

  std::vector<Eigen::Index> at;  ///< those with a weight
  Eigen::ArrayXd weight;         ///< theirs
};

/// The baseline's columns on some rows, kept like shared_baseline(). Thread-safe.
std::shared_ptr<const WeightedBaseline> weighted_baseline(const Frame& frame, Equation equation,
                                                          std::span<const double> shape,
                                                          const WeightedRows& rows);

}  // namespace flexspline::studies
