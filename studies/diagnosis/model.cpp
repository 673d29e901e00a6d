#include "diagnosis/model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "diagnosis/model_columns.hpp"

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
constexpr double kSmallestGain = 1e-5;  // of the sum of squares: a tenth in chi square of 10^4 rows
constexpr double kFree = -std::numeric_limits<double>::infinity();

// Searched in the logarithm where a shape is.
double inner(const Shape& shape, double value) {
  return shape.logarithmic ? std::log(value) : value;
}
double outer(const Shape& shape, double value) {
  return shape.logarithmic ? std::exp(value) : value;
}

std::vector<Shape> shapes_of(const ActiveCause& cause, const Frame& frame) {
  return cause.form->shapes == nullptr ? std::vector<Shape>{} : cause.form->shapes(frame);
}

/// Where every number of a model stands among the shapes q and the linear parameters b.
class Layout {
 public:
  Layout(const Frame& frame, std::vector<Equation> equations, const DriveModel& model)
      : frame_(frame), equations_(std::move(equations)), model_(model) {
    for (const ActiveCause& cause : model.causes) shapes_.push_back(shapes_of(cause, frame));
  }

  std::vector<double> shapes_start() const {
    std::vector<double> q;
    if (fits(Equation::torsion)) q = model_.torsion_shape;
    for (std::size_t c = 0; c < model_.causes.size(); ++c) {
      for (std::size_t s = 0; s < shapes_[c].size(); ++s) {
        q.push_back(inner(shapes_[c][s], model_.causes[c].shape[s]));
      }
    }
    return q;
  }

  std::vector<ShapeBound> bounds() const {
    std::vector<ShapeBound> list;
    const auto q = shapes_start();
    const auto add = [&](double lower, double upper) {
      list.push_back({q[list.size()], lower, upper});
    };
    if (fits(Equation::torsion) && frame_.travels) {
      add(std::log(1e-4 * frame_.rate_range), std::log(0.3 * frame_.rate_range));
    } else if (fits(Equation::torsion)) {
      const double zero = frame_.rig == Rig::specimen ? kMostBesideOffset : kMostZeroError;
      add(-2.0, 2.0), add(-2.0, 2.0), add(-zero, zero);
    }
    for (const auto& shapes : shapes_) {
      for (const Shape& s : shapes) {
        if (s.discrete) {
          add(q[list.size()], q[list.size()]);
        } else {
          add(inner(s, s.lower), inner(s, s.upper));
        }
      }
    }
    return list;
  }

  /// The model with these shapes.
  DriveModel at(std::span<const double> q) const {
    DriveModel model = model_;
    std::size_t next = 0;
    if (fits(Equation::torsion)) {
      for (double& value : model.torsion_shape) value = q[next++];
    }
    for (std::size_t c = 0; c < model.causes.size(); ++c) {
      for (std::size_t s = 0; s < shapes_[c].size(); ++s) {
        model.causes[c].shape[s] = outer(shapes_[c][s], q[next++]);
      }
    }
    return model;
  }

  bool fits(Equation equation) const { return std::ranges::count(equations_, equation) > 0; }
  const std::vector<Equation>& equations() const { return equations_; }

 private:
  const Frame& frame_;
  std::vector<Equation> equations_;
  const DriveModel& model_;
  std::vector<std::vector<Shape>> shapes_;
};

/// Linear parameters: the baseline's by equation, then the causes'.
struct LinearLayout {
  std::vector<Index> own_at, own_size, cause_at, cause_size;
  Eigen::VectorXd lower;
};

LinearLayout linear_layout(ModelColumns& columns, const DriveModel& model,
                           const std::vector<Equation>& equations,
                           const std::vector<WeightedRows>& rows) {
  LinearLayout layout;
  std::vector<double> lower;
  layout.cause_size.assign(model.causes.size(), 0);
  for (std::size_t e = 0; e < equations.size(); ++e) {
    const auto own = weighted_baseline(columns.seen(model), equations[e],
                                       baseline_shape(model, equations[e]), rows[e]);
    layout.own_at.push_back(static_cast<Index>(lower.size()));
    layout.own_size.push_back(own->lower.size());
    lower.insert(lower.end(), own->lower.begin(), own->lower.end());
    const auto causes = columns.causes_at(model, equations[e]);
    for (std::size_t k = 0; k < causes.size(); ++k) {
      layout.cause_size[k] = std::max(layout.cause_size[k], static_cast<Index>(causes[k]->size()));
    }
  }
  for (std::size_t k = 0; k < model.causes.size(); ++k) {
    layout.cause_at.push_back(static_cast<Index>(lower.size()));
    lower.insert(lower.end(), static_cast<std::size_t>(layout.cause_size[k]),
                 model.causes[k].form->nonnegative ? 0.0 : kFree);
  }
  layout.lower = Eigen::Map<Eigen::VectorXd>(lower.data(), static_cast<Index>(lower.size()));
  return layout;
}

SeparableBlock weighted_block(ModelColumns& columns, const DriveModel& model, Equation equation,
                              const WeightedRows& rows, const LinearLayout& layout, std::size_t e) {
  SeparableBlock block;
  block.shared =
      weighted_baseline(columns.seen(model), equation, baseline_shape(model, equation), rows)
          ->columns;
  for (Index k = 0; k < layout.own_size[e]; ++k) block.index.push_back(layout.own_at[e] + k);
  const auto causes = columns.causes_at(model, equation);
  for (std::size_t k = 0; k < causes.size(); ++k) {
    for (std::size_t j = 0; j < causes[k]->size(); ++j) {
      block.index.push_back(layout.cause_at[k] + static_cast<Index>(j));
    }
  }
  block.columns.resize(rows.weight.size(),
                       static_cast<Index>(block.index.size()) - layout.own_size[e]);
  Index next = 0;
  for (const auto& list : causes) {
    for (const ArrayXd& column : *list) {
      block.columns.col(next++) = (column(rows.at) * rows.weight).matrix();
    }
  }
  block.target = (target_of(columns.seen(model), equation)(rows.at) * rows.weight).matrix();
  return block;
}

void take_coefficients(DriveModel& model, const LinearLayout& layout, const Eigen::VectorXd& b,
                       const std::vector<Equation>& equations) {
  model.own.resize(3);
  for (std::size_t e = 0; e < equations.size(); ++e) {
    model.own[index_of(equations[e])] = b.segment(layout.own_at[e], layout.own_size[e]);
  }
  model.coefficients.clear();
  for (std::size_t k = 0; k < model.causes.size(); ++k) {
    model.coefficients.push_back(b.segment(layout.cause_at[k], layout.cause_size[k]));
  }
}

int count_free(const Eigen::VectorXd& b, const Eigen::VectorXd& lower, std::size_t shapes) {
  int count = static_cast<int>(shapes);
  for (Index k = 0; k < b.size(); ++k) count += b[k] > lower[k] || !std::isfinite(lower[k]) ? 1 : 0;
  return count;
}

ArrayXd prediction_of(const EquationColumns& c, const DriveModel& model, Equation equation) {
  ArrayXd sum = (c.own->columns * model.own[index_of(equation)]).array();
  for (std::size_t k = 0; k < c.causes.size(); ++k) {
    for (std::size_t j = 0; j < c.causes[k]->size(); ++j) {
      sum += model.coefficients[k][static_cast<Index>(j)] * (*c.causes[k])[j];
    }
  }
  return sum;
}

void fill_residuals(const Frame& frame, ModelColumns& columns,
                    const std::vector<Equation>& equations, ModelFit& fit) {
  for (Equation equation : equations) {
    const std::size_t e = index_of(equation);
    const auto c = columns.at(fit.model, equation);
    fit.residual[e] =
        target_of(columns.seen(fit.model), equation) - prediction_of(c, fit.model, equation);
    fit.prediction[e] =
        (equation == Equation::motor ? frame.motor_torque : frame.torque) - fit.residual[e];
  }
}

// What a cause adds to the torsion equation before the torque is recorded.
ArrayXd unfiltered(const Frame& seen, const Reference& reference, const DriveModel& model,
                   std::size_t i) {
  const ActiveCause& cause = model.causes[i];
  ArrayXd sum = ArrayXd::Zero(seen.rows());
  if (model.coefficients.size() <= i) return sum;
  const Columns columns = cause.form->columns(Equation::torsion, seen, reference, cause.shape);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    sum += model.coefficients[i][static_cast<Index>(k)] * columns[k];
  }
  return sum;
}

}  // namespace

DriveModel first_guess(const Frame& frame) {
  DriveModel model;
  if (frame.travels) {
    model.torsion_shape = {std::log(0.02 * frame.rate_range)};
  } else {
    model.torsion_shape = {0.0, 0.0, 0.0};
  }
  return model;
}

Result<ModelFit> fit_model(const Frame& frame, const PerEquation& weight,
                           const std::vector<Equation>& equations, const DriveModel& start,
                           const Reference& reference, int most_steps) {
  const Layout layout(frame, equations, start);
  std::vector<WeightedRows> rows;
  for (Equation equation : equations) rows.emplace_back(weight[index_of(equation)]);
  ModelColumns columns(frame, reference);
  const LinearLayout linear =
      linear_layout(columns, layout.at(layout.shapes_start()), equations, rows);
  estimators::SeparableProblem problem;
  problem.lower = linear.lower;
  problem.shapes = layout.bounds();
  problem.assemble = [&](std::span<const double> q) {
    const DriveModel model = layout.at(q);
    std::vector<SeparableBlock> blocks;
    for (std::size_t e = 0; e < equations.size(); ++e) {
      blocks.push_back(weighted_block(columns, model, equations[e], rows[e], linear, e));
    }
    return blocks;
  };
  const auto solved = estimators::fit_separable(problem, most_steps, kSmallestGain);
  if (!solved) return tl::unexpected(solved.error());
  ModelFit fit;
  fit.model = layout.at(solved->q);
  take_coefficients(fit.model, linear, solved->b, equations);
  for (std::size_t e = 0; e < equations.size(); ++e) {
    fit.sum_of_squares[index_of(equations[e])] = solved->residual[e].squaredNorm();
  }
  fit.free_parameters = count_free(solved->b, linear.lower, solved->q.size());
  fit.evaluations = solved->evaluations;
  fill_residuals(frame, columns, equations, fit);
  return fit;
}

ModelFit evaluate(const Frame& frame, const DriveModel& model, const Reference& reference) {
  ModelFit fit;
  fit.model = model;
  std::vector<Equation> known;
  for (Equation equation : frame.equations) {
    if (model.own.size() > index_of(equation) && model.own[index_of(equation)].size() > 0) {
      known.push_back(equation);
    }
  }
  ModelColumns columns(frame, reference);
  fill_residuals(frame, columns, known, fit);
  return fit;
}

ArrayXd motor_sign(const Frame& frame, const DriveModel& model) {
  const std::size_t e = index_of(Equation::motor);
  const double narrow = 0.01 * std::max(frame.speed_range, 1e-300);
  if (model.own.size() <= e || model.own[e].size() == 0) {
    return rounded_sign(frame.motor_speed, narrow);
  }
  const auto own = shared_baseline(frame, Equation::motor, {});
  const Eigen::VectorXd dry = model.own[e].segment(own->elastic, own->dissipative);
  if (!(dry.sum() > 0.0)) return rounded_sign(frame.motor_speed, narrow);
  return (own->columns.middleCols(own->elastic, own->dissipative) * dry).array() / dry.sum();
}

Reference reference_of(const Frame& frame, const DriveModel& model) {
  Reference reference;
  reference.elastic = ArrayXd::Zero(frame.rows());
  reference.dissipative = ArrayXd::Zero(frame.rows());
  reference.friction = reference.dissipative;
  reference.motor_sign = motor_sign(frame, model);
  reference.torsion_coulomb_rate = coulomb_width(frame, model.torsion_shape);
  const std::size_t e = index_of(Equation::torsion);
  if (model.own.size() <= e || model.own[e].size() == 0) return reference;
  ModelColumns columns(frame, reference);
  Frame seen = columns.seen(model);
  seen.torque_lag = 0.0;
  const auto own = shared_baseline(seen, Equation::torsion, model.torsion_shape);
  const Eigen::VectorXd& b = model.own[e];
  reference.elastic = (own->columns.leftCols(own->elastic) * b.head(own->elastic)).array();
  reference.dissipative = (own->columns.middleCols(own->elastic, own->dissipative) *
                           b.segment(own->elastic, own->dissipative))
                              .array();
  reference.friction = reference.dissipative;
  for (std::size_t i = 0; i < model.causes.size(); ++i) {
    if (model.causes[i].form->friction) reference.friction += unfiltered(seen, reference, model, i);
  }
  return reference;
}

ArrayXd contribution(const Frame& frame, const DriveModel& model, const Reference& reference,
                     std::size_t cause, Equation equation) {
  DriveModel without = model;
  without.causes.erase(without.causes.begin() + static_cast<long>(cause));
  without.coefficients.erase(without.coefficients.begin() + static_cast<long>(cause));
  const auto with = evaluate(frame, model, reference).residual[index_of(equation)];
  const auto less = evaluate(frame, without, reference).residual[index_of(equation)];
  if (with.size() == 0 || less.size() == 0) return ArrayXd::Zero(frame.rows());
  return less - with;
}

std::vector<Equation> equations_touched(const Frame& frame,
                                        const std::vector<ActiveCause>& causes) {
  std::set<Equation> touched;
  for (const ActiveCause& cause : causes) {
    for (Equation equation : cause.form->at) {
      if (frame.has(equation)) touched.insert(equation);
    }
  }
  // A cause of several equations links them through its coefficients.
  return {touched.begin(), touched.end()};
}

}  // namespace flexspline::studies
