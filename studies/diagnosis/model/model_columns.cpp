#include "diagnosis/model/model_columns.hpp"

#include <algorithm>

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;

constexpr std::size_t kMostBuilt = 12;  // of a fit: a few causes, before and after a difference

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

const Frame& ModelColumns::seen(const DriveModel& model) {
  auto changes = changes_of(model);
  if (changes.empty()) return frame_;
  if (changed_ && changes == changed_by_) return *changed_;
  built_.clear();
  changed_ = frame_;
  for (const ActiveCause& cause : model.causes) {
    if (cause.form->transform != nullptr) cause.form->transform(*changed_, cause.shape);
  }
  changed_->weigh_load();
  changed_->measure_torsion();
  changed_by_ = std::move(changes);
  return *changed_;
}

std::shared_ptr<const Columns> ModelColumns::columns_of(const Frame& seen, const ActiveCause& cause,
                                                        Equation equation) {
  const auto found = std::ranges::find_if(built_, [&](const Built& b) {
    return b.form == cause.form && b.equation == equation && b.shape == cause.shape;
  });
  if (found != built_.end()) {
    built_.splice(built_.begin(), built_, found);
    return built_.front().columns;
  }
  if (built_.size() == kMostBuilt) built_.pop_back();
  Columns columns = cause.form->columns(equation, seen, reference_, cause.shape);
  if (seen.torque_lag > 0.0) {
    for (ArrayXd& column : columns) column = seen.recorded(column);
  }
  built_.push_front(
      {cause.form, equation, cause.shape, std::make_shared<const Columns>(std::move(columns))});
  return built_.front().columns;
}

std::vector<std::shared_ptr<const Columns>> ModelColumns::causes_at(const DriveModel& model,
                                                                    Equation equation) {
  static const auto none = std::make_shared<const Columns>();
  const Frame& frame = seen(model);
  std::vector<std::shared_ptr<const Columns>> list;
  for (const ActiveCause& cause : model.causes) {
    const bool adds = cause.form->columns != nullptr && acts_on(cause, equation);
    list.push_back(adds ? columns_of(frame, cause, equation) : none);
  }
  return list;
}

EquationColumns ModelColumns::at(const DriveModel& model, Equation equation) {
  return {shared_baseline(seen(model), equation, baseline_shape(model, equation)),
          causes_at(model, equation)};
}

}  // namespace flexspline::studies
