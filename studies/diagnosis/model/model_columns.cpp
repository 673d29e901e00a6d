#include "diagnosis/model/model_columns.hpp"

#include <algorithm>

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;

constexpr std::size_t kMostBuilt = 12;  // of a fit: a few causes, before and after a difference
constexpr std::size_t kMostSeen = 2;    // before and after a difference

bool acts_on(const ActiveCause& cause, Equation equation) {
  return std::ranges::count(cause.form->at, equation) > 0;
}

std::vector<std::vector<double>> changes_of(const DriveModel& model) {
  std::vector<std::vector<double>> shapes;
  for (const ActiveCause& cause : model.causes) {
    if (cause.form->transform != nullptr) shapes.push_back(cause.shape);
  }
  return shapes;
}

}  // namespace

void add_causes(const std::vector<std::shared_ptr<const Columns>>& causes,
                const std::vector<Eigen::VectorXd>& coefficients, double times, ArrayXd& sum) {
  for (std::size_t k = 0; k < causes.size(); ++k) {
    for (std::size_t j = 0; j < causes[k]->size(); ++j) {
      sum += times * coefficients[k][static_cast<Eigen::Index>(j)] * (*causes[k])[j];
    }
  }
}

std::span<const double> baseline_shape(const DriveModel& model, Equation equation) {
  if (equation == Equation::torsion) return model.torsion_shape;
  return {};
}

const ModelColumns::Seen& ModelColumns::seen_by(const DriveModel& model) {
  auto changes = changes_of(model);
  const auto found = std::ranges::find(seen_, changes, &Seen::changed_by);
  if (found != seen_.end()) {
    seen_.splice(seen_.begin(), seen_, found);
    return seen_.front();
  }
  // A frame is written over in less time than it takes to make another.
  if (seen_.size() == kMostSeen) {
    seen_.splice(seen_.begin(), seen_, std::prev(seen_.end()));
  } else {
    seen_.emplace_front();
  }
  Seen& made = seen_.front();
  std::erase_if(built_, [&](const Built& b) { return b.on == &made; });
  made.changed_by = std::move(changes);
  if (made.changed_by.empty()) {
    made.changed.reset();
    return made;
  }
  made.changed = frame_;
  for (const ActiveCause& cause : model.causes) {
    if (cause.form->transform != nullptr) cause.form->transform(*made.changed, cause.shape);
  }
  made.changed->weigh_load();
  made.changed->measure_torsion();
  return made;
}

const Frame& ModelColumns::seen(const DriveModel& model) { return frame_of(seen_by(model)); }

std::shared_ptr<const Columns> ModelColumns::columns_of(const Seen& seen, const ActiveCause& cause,
                                                        Equation equation) {
  static const auto none = std::make_shared<const Columns>();
  if (cause.form->columns == nullptr || !acts_on(cause, equation)) return none;
  const auto found = std::ranges::find_if(built_, [&](const Built& b) {
    return b.on == &seen && b.form == cause.form && b.equation == equation &&
           b.shape == cause.shape;
  });
  if (found != built_.end()) {
    built_.splice(built_.begin(), built_, found);
    return built_.front().columns;
  }
  if (built_.size() == kMostBuilt) built_.pop_back();
  const Frame& frame = frame_of(seen);
  Columns columns = cause.form->columns(equation, frame, reference_, cause.shape);
  if (frame.torque_lag > 0.0) {
    for (ArrayXd& column : columns) column = frame.recorded(column);
  }
  built_.push_front({&seen, cause.form, equation, cause.shape,
                     std::make_shared<const Columns>(std::move(columns))});
  return built_.front().columns;
}

std::shared_ptr<const Columns> ModelColumns::of_cause(const DriveModel& model, std::size_t cause,
                                                      Equation equation) {
  return columns_of(seen_by(model), model.causes[cause], equation);
}

std::vector<std::shared_ptr<const Columns>> ModelColumns::causes_at(const DriveModel& model,
                                                                    Equation equation) {
  const Seen& seen = seen_by(model);
  std::vector<std::shared_ptr<const Columns>> list;
  for (const ActiveCause& cause : model.causes) list.push_back(columns_of(seen, cause, equation));
  return list;
}

EquationColumns ModelColumns::at(const DriveModel& model, Equation equation) {
  return {shared_baseline(seen(model), equation, baseline_shape(model, equation)),
          causes_at(model, equation)};
}

}  // namespace flexspline::studies
