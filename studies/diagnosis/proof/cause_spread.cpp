#include "diagnosis/proof/cause_spread.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>

#include "diagnosis/model/cause_columns.hpp"
#include "diagnosis/model/rig_constants.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr double kNormal95 = 1.959964;
constexpr double kShapeStep = 1e-4;  // of a shape's range, or of its value; of a gain, its share
constexpr double kUntold = 1e-10;    // eigenvalue of a correlation that says nothing

std::vector<Shape> shapes_of(const ActiveCause& cause, const Frame& frame) {
  return cause.form->shapes == nullptr ? std::vector<Shape>{} : cause.form->shapes(frame);
}

bool on_bound(const Shape& shape, double value) {
  const double near = kShapeStep * (shape.upper - shape.lower);
  return value <= shape.lower + near || value >= shape.upper - near;
}

double step_of(const Shape& shape, double value) {
  return kShapeStep * (shape.logarithmic ? value : shape.upper - shape.lower);
}

std::vector<Term> terms_of(const ActiveCause& cause, const Frame& frame, Index columns) {
  if (cause.form->terms != nullptr) return cause.form->terms(frame);
  return std::vector<Term>(static_cast<std::size_t>(columns), Term{"coefficient", "", "of a term"});
}

}  // namespace

CauseSpread::CauseSpread(const Frame& frame, const Findings& findings)
    : frame_(frame), findings_(findings), weight_(findings.weight) {
  for (Equation equation : frame.equations) {
    const std::size_t e = index_of(equation);
    const double rows = static_cast<double>((weight_[e] > 0.0).count());
    const double mean_square = findings.fit.sum_of_squares[e] / std::max(rows, 1.0);
    weight_[e] /= std::sqrt(std::max(mean_square, 1.0) * findings.noise[e].colour);
  }
  if (findings.fit.model.causes.empty()) return;
  list_free();
  solve();
}

void CauseSpread::list_free() {
  const DriveModel& model = findings_.fit.model;
  for (Equation equation : frame_.equations) {
    const std::size_t e = index_of(equation);
    for (Index k = 0; k < model.own[e].size(); ++k) {
      if (model.own[e][k] != 0.0) free_.push_back({false, e, k, true, 1.0});
    }
  }
  const bool torsion = frame_.has(Equation::torsion);
  for (std::size_t k = 0; torsion && k < model.torsion_shape.size(); ++k) {
    free_.push_back({true, 0, static_cast<Index>(k), true, kShapeStep});
  }
  for (std::size_t c = 0; c < model.causes.size(); ++c) {
    const auto shapes = shapes_of(model.causes[c], frame_);
    for (std::size_t k = 0; k < shapes.size(); ++k) {
      const double value = model.causes[c].shape[k];
      if (shapes[k].discrete || on_bound(shapes[k], value)) continue;
      free_.push_back({true, c, static_cast<Index>(k), false, step_of(shapes[k], value)});
    }
    for (Index k = 0; k < model.coefficients[c].size(); ++k) {
      if (model.coefficients[c][k] != 0.0) free_.push_back({false, c, k, false, 1.0});
    }
  }
}

DriveModel CauseSpread::moved(const Free& p) const {
  DriveModel model = findings_.fit.model;
  const auto k = static_cast<std::size_t>(p.index);
  if (p.baseline) {
    (p.shape ? model.torsion_shape[k] : model.own[p.cause][p.index]) += p.step;
  } else {
    (p.shape ? model.causes[p.cause].shape[k] : model.coefficients[p.cause][p.index]) += p.step;
  }
  return model;
}

Eigen::VectorXd CauseSpread::slope(const Free& parameter) const {
  const ModelFit then = evaluate(frame_, moved(parameter), findings_.reference);
  Eigen::VectorXd all(frame_.rows() * static_cast<Index>(frame_.equations.size()));
  Index at = 0;
  for (Equation equation : frame_.equations) {
    const std::size_t e = index_of(equation);
    all.segment(at, frame_.rows()) =
        ((then.residual[e] - findings_.fit.residual[e]) / parameter.step * weight_[e]).matrix();
    at += frame_.rows();
  }
  return all;
}

Eigen::VectorXd CauseSpread::weighted_residual() const {
  Eigen::VectorXd all(frame_.rows() * static_cast<Index>(frame_.equations.size()));
  Index at = 0;
  for (Equation equation : frame_.equations) {
    const std::size_t e = index_of(equation);
    all.segment(at, frame_.rows()) = (findings_.fit.residual[e] * weight_[e]).matrix();
    at += frame_.rows();
  }
  return all;
}

void CauseSpread::solve() {
  const auto count = static_cast<Index>(free_.size());
  Eigen::MatrixXd jacobian(frame_.rows() * static_cast<Index>(frame_.equations.size()), count);
  for (Index k = 0; k < count; ++k) jacobian.col(k) = slope(free_[static_cast<std::size_t>(k)]);
  const Eigen::VectorXd norm = jacobian.colwise().norm().cwiseMax(1e-300);
  jacobian = jacobian * norm.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(jacobian.transpose() * jacobian);
  const Eigen::VectorXd inverse = eigen.eigenvalues().cwiseMax(kUntold).cwiseInverse();
  const Eigen::MatrixXd& vectors = eigen.eigenvectors();
  const auto unscaled = norm.cwiseInverse().asDiagonal();
  by_noise_ = unscaled * vectors * inverse.cwiseSqrt().asDiagonal();
  apart_ = jackknife(jacobian, weighted_residual(), pieces_of(frame_));
  apart_.moves = unscaled * apart_.moves;
  told_.assign(free_.size(), true);
  for (Index m = 0; m < count; ++m) {
    if (eigen.eigenvalues()[m] > kUntold) continue;
    for (Index k = 0; k < count; ++k) {
      if (std::abs(vectors(k, m)) > 0.1) told_[static_cast<std::size_t>(k)] = false;
    }
  }
}

Spread CauseSpread::spread_of(const Eigen::VectorXd& slopes) const {
  for (std::size_t k = 0; k < told_.size(); ++k) {
    if (!told_[k] && slopes[static_cast<Index>(k)] != 0.0) return {};
  }
  const double by_noise = (by_noise_.transpose() * slopes).norm();
  const double apart = (apart_.moves.transpose() * slopes).norm();
  if (!std::isfinite(by_noise) || !std::isfinite(apart)) return {};
  return {std::max(by_noise, apart), std::max(kNormal95 * by_noise, apart_.quantile * apart)};
}

Spread CauseSpread::size(std::size_t cause,
                         const std::function<double(const DriveModel&)>& size_in) const {
  Eigen::VectorXd slopes = Eigen::VectorXd::Zero(std::ssize(free_));
  const double now = size_in(findings_.fit.model);
  for (std::size_t k = 0; k < free_.size(); ++k) {
    const Free& f = free_[k];
    if (f.baseline || f.cause != cause) continue;
    slopes[static_cast<Index>(k)] = (size_in(moved(f)) - now) / f.step;
  }
  return spread_of(slopes);
}

std::pair<double, double> CauseSpread::bounds_of(const Free& parameter) const {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const ActiveCause& cause = findings_.fit.model.causes[parameter.cause];
  if (!parameter.shape) return {cause.form->nonnegative ? 0.0 : -kNone, kNone};
  const Shape shape = cause.form->shapes(frame_)[static_cast<std::size_t>(parameter.index)];
  return {shape.lower, shape.upper};
}

std::optional<std::size_t> CauseSpread::find(bool shape, std::size_t cause, Index index) const {
  for (std::size_t k = 0; k < free_.size(); ++k) {
    const Free& f = free_[k];
    if (!f.baseline && f.shape == shape && f.cause == cause && f.index == index) return k;
  }
  return std::nullopt;
}

void CauseSpread::attach_spread(std::optional<std::size_t> at, const Eigen::VectorXd& slopes,
                                CauseParameter& p) const {
  if (!at) {
    p.no_interval = "it is at an end of its range";
    return;
  }
  const Spread spread = spread_of(slopes);
  p.std = spread.std;
  if (std::isfinite(p.std)) {
    const auto [lower, upper] = bounds_of(free_[*at]);
    p.ci95_lower = std::max(p.value - spread.half, lower);
    p.ci95_upper = std::min(p.value + spread.half, upper);
  } else {
    p.no_interval = "not identifiable beside the others on these recordings";
  }
}

CauseSpread::Catalogued CauseSpread::catalogued(std::size_t cause) const {
  const DriveModel& model = findings_.fit.model;
  const auto in = [&](const DriveModel& other) {
    return catalogued_coefficients(frame_, other, cause, findings_.reference);
  };
  Catalogued told{in(model), {}};
  told.slopes = Eigen::MatrixXd::Zero(std::ssize(free_), told.value.size());
  for (std::size_t k = 0; k < free_.size(); ++k) {
    Free f = free_[k];
    if (f.baseline || f.shape) continue;
    const bool rescales = model.causes[f.cause].form->rescales;
    if (f.cause != cause && !rescales) continue;
    if (rescales) f.step = kShapeStep;
    told.slopes.row(static_cast<Index>(k)) = (in(moved(f)) - told.value).transpose() / f.step;
  }
  return told;
}

std::vector<CauseParameter> CauseSpread::parameters(std::size_t cause) const {
  const DriveModel& model = findings_.fit.model;
  const ActiveCause& active = model.causes[cause];
  std::vector<CauseParameter> list;
  const auto shapes = shapes_of(active, frame_);
  const auto unit = [&](std::size_t at) -> Eigen::VectorXd {
    return Eigen::VectorXd::Unit(std::ssize(free_), static_cast<Index>(at));
  };
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    if (active.shape[k] == 0.0) continue;
    CauseParameter p{std::string(shapes[k].name), active.shape[k], kNotComputed,
                     std::string(shapes[k].unit)};
    p.meaning = shapes[k].meaning;
    const auto at = find(true, cause, static_cast<Index>(k));
    attach_spread(at, at ? unit(*at) : Eigen::VectorXd(), p);
    if (shapes[k].discrete) p.no_interval = "a whole number that was tried, not fitted";
    list.push_back(std::move(p));
  }
  const Catalogued told = catalogued(cause);
  const Eigen::VectorXd& a = told.value;
  const auto terms = terms_of(active, frame_, a.size());
  for (Index k = 0; k < a.size(); ++k) {
    const Term& term = terms[static_cast<std::size_t>(k)];
    if (a[k] == 0.0) continue;
    CauseParameter p{term.name, a[k], kNotComputed, term.unit};
    p.meaning = term.meaning;
    attach_spread(find(false, cause, k), told.slopes.col(k), p);
    list.push_back(std::move(p));
    if (term.grid_name.empty()) continue;
    CauseParameter grid{term.grid_name, term.grid_value, kNotComputed, term.grid_unit};
    grid.meaning = term.grid_meaning;
    grid.no_interval = "of a fixed grid, not fitted";
    list.push_back(std::move(grid));
  }
  return list;
}

}  // namespace flexspline::studies
