#include "diagnosis/model/model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "diagnosis/model/cause_columns.hpp"
#include "diagnosis/model/model_problem.hpp"
#include "diagnosis/model/motor_sign.hpp"
#include "diagnosis/model/torsion_sign.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

int count_free(const Eigen::VectorXd& b, const Eigen::VectorXd& lower, std::size_t shapes) {
  int count = static_cast<int>(shapes);
  for (Index k = 0; k < b.size(); ++k) count += b[k] > lower[k] || !std::isfinite(lower[k]) ? 1 : 0;
  return count;
}

ArrayXd prediction_of(ModelColumns& columns, const DriveModel& model, Equation equation) {
  const auto causes = columns.causes_at(model, equation);
  const Frame& seen = columns.seen(model);
  const Eigen::VectorXd& own = model.own[index_of(equation)];
  ArrayXd sum = equation == Equation::torsion
                    ? baseline_torque(seen, model.torsion_shape, own).sum()
                    : ArrayXd(shared_baseline(seen, equation, {})->columns * own);
  add_causes(causes, model.coefficients, 1.0, sum);
  return sum;
}

void fill_residuals(const Frame& frame, ModelColumns& columns,
                    const std::vector<Equation>& equations, ModelFit& fit) {
  for (Equation equation : equations) {
    const std::size_t e = index_of(equation);
    fit.residual[e] =
        target_of(columns.seen(fit.model), equation) - prediction_of(columns, fit.model, equation);
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

void take_gear(const Frame& frame, const DriveModel& model, Reference& reference) {
  const std::size_t e = index_of(Equation::torsion);
  if (model.own.size() <= e || model.own[e].size() == 0) {
    reference.torsion_sign = torsion_sign(frame, model);
    return;
  }
  ModelColumns columns(frame, reference);
  Frame seen = columns.seen(model);
  reference.torsion_sign = torsion_sign(seen, model);
  seen.torque_lag = 0.0;
  BaselineTorque own = baseline_torque(seen, model.torsion_shape, model.own[e]);
  reference.elastic = std::move(own.elastic);
  reference.dissipative = std::move(own.dissipative);
  reference.friction = reference.dissipative;
  for (std::size_t i = 0; i < model.causes.size(); ++i) {
    if (model.causes[i].form->friction) reference.friction += unfiltered(seen, reference, model, i);
  }
}

double torque_offset_of(const DriveModel& model) {
  double sum = 0.0;
  for (std::size_t i = 0; i < std::min(model.causes.size(), model.coefficients.size()); ++i) {
    if (model.causes[i].form->offsets_torque) sum += model.coefficients[i].sum();
  }
  return sum;
}

DriveModel without_trailing(DriveModel model) {
  for (std::size_t i = model.causes.size(); i-- > 0;) {
    if (!model.causes[i].form->trails) continue;
    model.causes.erase(model.causes.begin() + static_cast<long>(i));
    if (i < model.coefficients.size()) {
      model.coefficients.erase(model.coefficients.begin() + static_cast<long>(i));
    }
  }
  return model;
}

// Of the measured torque across the gear what is smooth.
ArrayXd asked_rate_of(const Frame& frame, const DriveModel& model, const Reference& reference) {
  const std::size_t e = index_of(Equation::motor);
  if (!frame.has(Equation::motor) || model.own.size() <= e || model.own[e].size() == 0) {
    return ArrayXd::Zero(frame.rows());
  }
  ModelFit fit;
  fit.model = without_trailing(model);
  ModelColumns columns(frame, reference);
  fill_residuals(frame, columns, {Equation::motor}, fit);
  ArrayXd asked = fit.prediction[e];
  if (frame.rig != Rig::servo) asked -= (frame.torque - frame.smooth_torque) / frame.ratio;
  return rate_of(frame, asked);
}

}  // namespace

DriveModel first_guess(const Frame& frame) {
  DriveModel model;
  if (!frame.travels) model.torsion_shape = {0.0, 0.0, 0.0};
  return model;
}

Result<ModelFit> fit_model(const Frame& frame, const PerEquation& weight,
                           const std::vector<Equation>& equations, const DriveModel& start,
                           const Reference& reference, const Effort& effort) {
  ModelColumns columns(frame, reference);
  const ModelProblem model(columns, frame, weight, equations, start);
  estimators::SeparableProblem problem;
  problem.lower = model.lower();
  problem.shapes = model.shapes();
  problem.assemble = [&](std::span<const double> q) { return model.assemble(q); };
  problem.changes = [&](const estimators::SeparableFit& fit, std::size_t shape, double step) {
    return model.changes(fit, shape, step);
  };
  const auto solved = estimators::fit_separable(problem, effort.most_steps, effort.smallest_gain);
  if (!solved) return tl::unexpected(solved.error());
  ModelFit fit;
  fit.model = model.at(solved->q);
  model.put_coefficients(solved->b, fit.model);
  for (std::size_t e = 0; e < equations.size(); ++e) {
    fit.sum_of_squares[index_of(equations[e])] = solved->residual[e].squaredNorm();
  }
  fit.free_parameters = count_free(solved->b, problem.lower, solved->q.size());
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

Reference reference_of(const Frame& frame, const DriveModel& model) {
  Reference reference;
  reference.elastic = ArrayXd::Zero(frame.rows());
  reference.dissipative = ArrayXd::Zero(frame.rows());
  reference.friction = reference.dissipative;
  reference.motor_sign = motor_sign(frame, model);
  reference.torque_offset = torque_offset_of(model);
  take_gear(frame, model, reference);
  reference.asked_rate = asked_rate_of(frame, model, reference);
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

double share_of_torque(const Frame& frame, const DriveModel& model, const Reference& reference,
                       std::size_t cause) {
  double size = 0.0;
  for (Equation equation : model.causes[cause].form->at) {
    if (!frame.has(equation)) continue;
    const ArrayXd part = contribution(frame, model, reference, cause, equation);
    size = std::max(size, (part.abs() * frame.usable).maxCoeff() / frame.largest_torque(equation));
  }
  return size;
}

double change_of_torque(const Frame& frame, const CauseForm& form, const ModelFit& with,
                        const ModelFit& without) {
  double change = 0.0;
  for (Equation equation : form.at) {
    if (!frame.has(equation)) continue;
    const std::size_t e = index_of(equation);
    const ArrayXd part = with.prediction[e] - without.prediction[e];
    change =
        std::max(change, (part.abs() * frame.usable).maxCoeff() / frame.largest_torque(equation));
  }
  return change;
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
