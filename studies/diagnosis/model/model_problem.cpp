#include "diagnosis/model/model_problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using estimators::SeparableBlock;
using estimators::ShapeBound;

// Of the torsion, over its range. Beside an offset of the torque a zero is nearly the same, and
// what is left to tell them apart are the spring's bends.
constexpr double kMostZeroError = 0.3;
constexpr double kMostBesideOffset = 0.1;
constexpr double kFree = -std::numeric_limits<double>::infinity();

std::vector<ShapeBound> baseline_bounds(const Frame& frame, const DriveModel& model) {
  if (frame.travels) return {};
  const auto& q = model.torsion_shape;
  const double zero = frame.rig == Rig::specimen ? kMostBesideOffset : kMostZeroError;
  return {{q[0], -2.0, 2.0}, {q[1], -2.0, 2.0}, {q[2], -zero, zero}};
}

}  // namespace

std::vector<Shape> shapes_of(const ActiveCause& cause, const Frame& frame) {
  return cause.form->shapes == nullptr ? std::vector<Shape>{} : cause.form->shapes(frame);
}

double inner(const Shape& shape, double value) {
  return shape.logarithmic ? std::log(value) : value;
}

double outer(const Shape& shape, double value) {
  return shape.logarithmic ? std::exp(value) : value;
}

ShapeBound bound_of(const Shape& shape, double value) {
  const double start = inner(shape, value);
  if (shape.discrete) return {start, start, start};
  return {start, inner(shape, shape.lower), inner(shape, shape.upper)};
}

ModelProblem::ModelProblem(ModelColumns& columns, const Frame& frame, const PerEquation& weight,
                           const std::vector<Equation>& equations, const DriveModel& start)
    : columns_(columns), frame_(frame), equations_(equations), start_(start) {
  for (Equation equation : equations) {
    rows_.emplace_back(weight[index_of(equation)], prior_rows(frame, equation));
  }
  for (const ActiveCause& cause : start.causes) cause_shapes_.push_back(shapes_of(cause, frame));
  lay_out_shapes();
  lay_out_linear();
}

bool ModelProblem::fits(Equation equation) const {
  return std::ranges::count(equations_, equation) > 0;
}

void ModelProblem::lay_out_shapes() {
  if (fits(Equation::torsion)) shapes_ = baseline_bounds(frame_, start_);
  for (std::size_t c = 0; c < start_.causes.size(); ++c) {
    for (std::size_t s = 0; s < cause_shapes_[c].size(); ++s) {
      shapes_.push_back(bound_of(cause_shapes_[c][s], start_.causes[c].shape[s]));
      cause_of_.push_back(c);
    }
  }
}

void ModelProblem::lay_out_linear() {
  std::vector<double> lower;
  causes_.assign(start_.causes.size(), {});
  for (std::size_t e = 0; e < equations_.size(); ++e) {
    const auto own = weighted_baseline(columns_.seen(start_), equations_[e],
                                       baseline_shape(start_, equations_[e]), rows_[e]);
    own_.push_back({static_cast<Index>(lower.size()), own->lower.size()});
    lower.insert(lower.end(), own->lower.begin(), own->lower.end());
    const auto causes = columns_.causes_at(start_, equations_[e]);
    for (std::size_t k = 0; k < causes.size(); ++k) {
      causes_[k].size = std::max(causes_[k].size, static_cast<Index>(causes[k]->size()));
    }
  }
  for (std::size_t k = 0; k < causes_.size(); ++k) {
    causes_[k].at = static_cast<Index>(lower.size());
    lower.insert(lower.end(), static_cast<std::size_t>(causes_[k].size),
                 start_.causes[k].form->nonnegative ? 0.0 : kFree);
  }
  lower_ = Eigen::Map<Eigen::VectorXd>(lower.data(), static_cast<Index>(lower.size()));
}

DriveModel ModelProblem::at(std::span<const double> q) const {
  DriveModel model = start_;
  std::size_t next = 0;
  if (fits(Equation::torsion)) {
    for (double& value : model.torsion_shape) value = q[next++];
  }
  for (std::size_t c = 0; c < model.causes.size(); ++c) {
    for (std::size_t s = 0; s < cause_shapes_[c].size(); ++s) {
      model.causes[c].shape[s] = outer(cause_shapes_[c][s], q[next++]);
    }
  }
  return model;
}

SeparableBlock ModelProblem::block_of(const DriveModel& model, std::size_t e) const {
  const Equation equation = equations_[e];
  const WeightedRows& rows = rows_[e];
  SeparableBlock block;
  block.shared =
      weighted_baseline(columns_.seen(model), equation, baseline_shape(model, equation), rows)
          ->columns;
  for (Index k = 0; k < own_[e].size; ++k) block.index.push_back(own_[e].at + k);
  const auto causes = columns_.causes_at(model, equation);
  for (std::size_t k = 0; k < causes.size(); ++k) {
    for (std::size_t j = 0; j < causes[k]->size(); ++j) {
      block.index.push_back(causes_[k].at + static_cast<Index>(j));
    }
  }
  block.columns.resize(rows.size(), static_cast<Index>(block.index.size()) - own_[e].size);
  Index next = 0;
  for (const auto& list : causes) {
    for (const ArrayXd& column : *list) {
      block.columns.col(next++) = rows.of(column);
    }
  }
  block.target = rows.of(target_of(columns_.seen(model), equation));
  return block;
}

std::vector<SeparableBlock> ModelProblem::assemble(std::span<const double> q) const {
  const DriveModel model = at(q);
  std::vector<SeparableBlock> blocks;
  for (std::size_t e = 0; e < equations_.size(); ++e) blocks.push_back(block_of(model, e));
  return blocks;
}

Eigen::VectorXd ModelProblem::residual_of(const DriveModel& model, std::size_t e) const {
  const Equation equation = equations_[e];
  const auto causes = columns_.causes_at(model, equation);
  const Frame& seen = columns_.seen(model);
  ArrayXd left = target_of(seen, equation);
  add_causes(causes, model.coefficients, -1.0, left);
  return rows_[e].of(left) - weighted_sum(seen, equation, baseline_shape(model, equation), rows_[e],
                                          model.own[index_of(equation)]);
}

std::vector<Eigen::VectorXd> ModelProblem::residuals(std::span<const double> q,
                                                     const Eigen::VectorXd& b) const {
  const DriveModel model = fitted(q, b);
  std::vector<Eigen::VectorXd> list;
  for (std::size_t e = 0; e < equations_.size(); ++e) list.push_back(residual_of(model, e));
  return list;
}

DriveModel ModelProblem::fitted(std::span<const double> q, const Eigen::VectorXd& b) const {
  DriveModel model = at(q);
  put_coefficients(b, model);
  return model;
}

std::vector<Eigen::VectorXd> ModelProblem::changes(const estimators::SeparableFit& fit,
                                                   std::size_t shape, double step) const {
  std::vector<double> q = fit.q;
  q[shape] += step;
  const DriveModel from = fitted(fit.q, fit.b);
  const std::size_t own = shapes_.size() - cause_of_.size();
  if (shape >= own && start_.causes[cause_of_[shape - own]].form->transform != nullptr) {
    auto changes = residuals(q, fit.b);
    for (std::size_t e = 0; e < changes.size(); ++e) changes[e] -= fit.residual[e];
    (void)columns_.seen(from);  // the next to be written over is the frame of this step
    return changes;
  }
  std::vector<Eigen::VectorXd> changes(equations_.size());
  const DriveModel to = fitted(q, fit.b);
  if (shape < own) {
    change_baseline(from, to, changes);
  } else {
    change_cause(from, to, cause_of_[shape - own], changes);
  }
  return changes;
}

void ModelProblem::change_baseline(const DriveModel& from, const DriveModel& to,
                                   std::vector<Eigen::VectorXd>& changes) const {
  const auto e = static_cast<std::size_t>(std::ranges::find(equations_, Equation::torsion) -
                                          equations_.begin());
  const Frame& seen = columns_.seen(from);
  const Eigen::VectorXd& b = from.own[index_of(Equation::torsion)];
  changes[e] =
      weighted_baseline(seen, Equation::torsion, from.torsion_shape, rows_[e])->columns->columns *
          b -
      weighted_sum(seen, Equation::torsion, to.torsion_shape, rows_[e], b);
}

void ModelProblem::change_cause(const DriveModel& from, const DriveModel& to, std::size_t cause,
                                std::vector<Eigen::VectorXd>& changes) const {
  for (std::size_t e = 0; e < equations_.size(); ++e) {
    const auto before = columns_.of_cause(from, cause, equations_[e]);
    if (before->empty()) continue;
    const auto after = columns_.of_cause(to, cause, equations_[e]);
    ArrayXd change = ArrayXd::Zero(frame_.rows());
    add_causes({before}, {from.coefficients[cause]}, 1.0, change);
    add_causes({after}, {from.coefficients[cause]}, -1.0, change);
    changes[e] = rows_[e].of(change);
  }
}

Eigen::VectorXd ModelProblem::coefficients_of(const DriveModel& model) const {
  Eigen::VectorXd b = Eigen::VectorXd::Zero(lower_.size());
  for (std::size_t e = 0; e < equations_.size(); ++e) {
    b.segment(own_[e].at, own_[e].size) = model.own[index_of(equations_[e])];
  }
  for (std::size_t k = 0; k < std::min(causes_.size(), model.coefficients.size()); ++k) {
    if (causes_[k].size == 0) continue;  // it acts on other equations
    b.segment(causes_[k].at, causes_[k].size) = model.coefficients[k];
  }
  return b;
}

void ModelProblem::put_coefficients(const Eigen::VectorXd& b, DriveModel& model) const {
  model.own.resize(3);
  for (std::size_t e = 0; e < equations_.size(); ++e) {
    model.own[index_of(equations_[e])] = b.segment(own_[e].at, own_[e].size);
  }
  model.coefficients.clear();
  for (const Place& cause : causes_) model.coefficients.push_back(b.segment(cause.at, cause.size));
}

}  // namespace flexspline::studies
