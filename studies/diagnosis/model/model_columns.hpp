#pragma once

#include <list>
#include <memory>
#include <optional>

#include "diagnosis/frame/shared_baseline.hpp"
#include "diagnosis/model/model.hpp"

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

  /// The frame as the causes of the model that change it leave it; valid until the next call with
  /// others.
  const Frame& seen(const DriveModel& model);
  EquationColumns at(const DriveModel& model, Equation equation);
  /// Of each cause alone.
  std::vector<std::shared_ptr<const Columns>> causes_at(const DriveModel& model, Equation equation);
  /// Of one of them.
  std::shared_ptr<const Columns> of_cause(const DriveModel& model, std::size_t cause,
                                          Equation equation);

 private:
  /// A frame as causes of these shapes leave it.
  struct Seen {
    std::vector<std::vector<double>> changed_by;
    std::optional<Frame> changed;
  };
  struct Built {
    const Seen* on;
    const CauseForm* form;
    Equation equation;
    std::vector<double> shape;
    std::shared_ptr<const Columns> columns;
  };
  const Seen& seen_by(const DriveModel& model);
  const Frame& frame_of(const Seen& seen) const { return seen.changed ? *seen.changed : frame_; }
  std::shared_ptr<const Columns> columns_of(const Seen& seen, const ActiveCause& cause,
                                            Equation equation);

  const Frame& frame_;
  const Reference& reference_;
  std::list<Seen> seen_;  ///< the latest first, as in the next
  std::list<Built> built_;
};

/// Adds to a sum, so many times, what causes add to an equation with their coefficients.
void add_causes(const std::vector<std::shared_ptr<const Columns>>& causes,
                const std::vector<Eigen::VectorXd>& coefficients, double times,
                Eigen::ArrayXd& sum);

/// Shapes of the baseline in one equation.
std::span<const double> baseline_shape(const DriveModel& model, Equation equation);

}  // namespace flexspline::studies
