#include "diagnosis/specification.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "diagnosis/baseline.hpp"
#include "diagnosis/law_fit.hpp"
#include "flexspline/core/effect.hpp"
#include "flexspline/core/effect_dependence.hpp"

namespace flexspline::studies {
namespace {

using Eigen::Index;

constexpr double kWorthSaying = 2e-3;  // error of a law over its largest value

/// The frame as the causes leave it, in which the baseline's laws were fitted.
Frame seen_by_the_laws(Frame frame, const DriveModel& model) {
  for (const ActiveCause& cause : model.causes) {
    if (cause.form->transform != nullptr) cause.form->transform(frame, cause.shape);
  }
  frame.measure_torsion();
  frame.torque_lag = 0.0;
  return frame;
}

/// Why an effect cannot stand in a model file; empty where it can.
std::string out_of_range(const EffectSpec& spec) {
  const auto row = find_effect(spec.effect);
  if (!row) return row.error().message();
  const auto values = parameter_values(**row, spec);
  if (!values) return values.error().message();
  const auto& parameters = (*row)->parameters;
  for (std::size_t k = 0; k < values->size(); ++k) {
    const EffectParameter& one = parameters[k % parameters.size()];
    const double value = (*values)[k];
    if (value >= one.lower && value <= one.upper) continue;
    return fmt::format("{} of {} is {:.4g} {}, which is outside {:.4g} to {:.4g}", one.name,
                       spec.effect, value, one.unit, one.lower, one.upper);
  }
  return {};
}

/// Whether it needs a motion that a torsion alone does not tell.
bool needs_shafts(const EffectSpec& spec, const CauseForm& form) {
  if (std::ranges::count(form.at, Equation::torsion) == 0) return true;
  const auto row = find_effect(spec.effect);
  const auto values = row ? parameter_values(**row, spec) : Result<std::vector<double>>{};
  if (!row || !values) return false;
  if ((*row)->site == Site::load_angle_signal || (*row)->site == Site::motor_angle_signal) {
    return true;
  }
  return depends_on(**row, *values, &Instant<Complex>::motor_angle) ||
         depends_on(**row, *values, &Instant<Complex>::load_angle);
}

/// Puts the causes of a model into effects, one after another.
class Specifier {
 public:
  Specifier(const Frame& frame, const DriveModel& model)
      : frame_(frame),
        model_(model),
        seen_(seen_by_the_laws(frame, model)),
        reference_(reference_of(frame, model)) {
    slipping_ = (reference_.friction - reference_.dissipative).abs().maxCoeff();
    if (frame.has(Equation::motor)) sign_ = sign_parts(seen_, reference_.motor_sign);
  }

  Specification specify() {
    for (std::size_t i = 0; i < model_.causes.size(); ++i) {
      add(model_.causes[i], model_.coefficients[i]);
    }
    put_laws();
    if (!shafts_.empty() && frame_.rig != Rig::specimen) {
      say("model.toml: simulate runs the torsion law alone; {} need the motions of motor and load, "
          "which only a simulation of the rig has",
          fmt::join(shafts_, ", "));
    }
    return {std::move(spec_), std::move(notes_)};
  }

 private:
  template <class... Args>
  void say(fmt::format_string<Args...> text, Args&&... args) {
    notes_.push_back(fmt::format(text, std::forward<Args>(args)...));
  }

  void add(const ActiveCause& cause, const Eigen::VectorXd& coefficients) {
    const CauseForm& form = *cause.form;
    if (form.counterpart == nullptr) {
      say("model.toml lacks {} ({}): {}", cause.row->id, form.equation,
          form.no_counterpart.empty() ? "the catalogue of effects has nothing like it"
                                      : form.no_counterpart);
      return;
    }
    Counterpart counterpart = form.counterpart(
        {seen_, cause.shape, coefficients, sign_, reference_.torsion_coulomb_rate, slipping_});
    for (const EffectSpec& effect : counterpart.effects) {
      const std::string why = out_of_range(effect);
      if (why.empty()) continue;
      say("model.toml lacks {} ({}): {}", cause.row->id, form.equation, why);
      return;
    }
    take(cause, std::move(counterpart));
  }

  void take(const ActiveCause& cause, Counterpart counterpart) {
    if (!counterpart.caveat.empty()) say("model.toml: {}: {}", cause.row->id, counterpart.caveat);
    for (EffectSpec& effect : counterpart.effects) {
      if (needs_shafts(effect, *cause.form) && !std::ranges::count(shafts_, effect.effect)) {
        shafts_.push_back(effect.effect);
      }
      spec_.effects.push_back(std::move(effect));
    }
    factor_ *= counterpart.law_factor;
    difference_ += counterpart.side_difference;
    if (counterpart.spring_sees) spring_sees_ = counterpart.spring_sees;
  }

  void put_laws() {
    const Eigen::VectorXd& own = model_.own[index_of(Equation::torsion)];
    const auto columns = baseline_columns(seen_, Equation::torsion, model_.torsion_shape);
    if (frame_.travels) {
      put_travelling_laws(own, columns.elastic);
    } else {
      put_gear_laws(own, columns.elastic + columns.dissipative);
    }
    for (LawSpec* law : {&spec_.f, &spec_.g_inverse}) {
      for (double& c : law->coefficients) c *= factor_;
    }
  }

  void put_gear_laws(const Eigen::VectorXd& own, Index laws) {
    const auto& shape = model_.torsion_shape;
    const double range = spring_sees_ ? frame_.torsion_range : seen_.torsion_range;
    FittedLaw f = elastic_law(seen_, own, range, spring_sees_);
    FittedLaw g = dissipative_law(seen_, own);
    for (const auto& [name, error] : {std::pair("f", f.error), std::pair("g^-1", g.error)}) {
      if (error < kWorthSaying) continue;
      say("model.toml: {} is within {:.2g} % of what was fitted", name, 100.0 * error);
    }
    spec_.f = std::move(f.law);
    spec_.g_inverse = std::move(g.law);
    spec_.h = modulation_law(seen_, shape, range, spring_sees_);
    split_sides();
    if (shape[2] != 0.0) {
      spec_.effects.push_back({"torsion_zero", {{"zero", shape[2] * seen_.torsion_range}}});
    }
    if (own.size() > laws)
      spec_.effects.push_back({"torque_sensor_offset", {{"offset", own[laws]}}});
  }

  void split_sides() {
    if (difference_ == 0.0) return;
    auto& both = spec_.g_inverse.coefficients;
    const std::vector<double> odd = both;
    for (double& c : both) c *= 1.0 + difference_;
    for (double c : odd) both.push_back((1.0 - difference_) * c);
  }

  // Dry friction as an effect, what grows with the rate as g^-1.
  void put_travelling_laws(const Eigen::VectorXd& own, Index travel) {
    spec_.f = {.law = "free_spline",
               .scale = 1.0,
               .knots = {seen_.torsion.minCoeff(), seen_.torsion.maxCoeff()},
               .coefficients = {own.begin(), own.begin() + travel},
               .valid_to = seen_.torsion_range};
    spec_.g_inverse = {.law = "odd_polynomial",
                       .scale = seen_.rate_range,
                       .knots = {},
                       .coefficients = {own[travel + 1]},
                       .valid_to = seen_.rate_range};
    spec_.h = {.law = "bounded_modulation", .scale = 1.0, .knots = {}, .coefficients = {}};
    spec_.effects.push_back({"coulomb_viscous_friction",
                             {{"coulomb", own[travel]},
                              {"viscous", 0.0},
                              {"smoothing", reference_.torsion_coulomb_rate}}});
  }

  const Frame& frame_;
  const DriveModel& model_;
  Frame seen_;
  Reference reference_;
  double slipping_ = 0.0;
  std::vector<SignPart> sign_;
  ModelSpec spec_;
  std::vector<std::string> notes_;
  std::vector<std::string> shafts_;
  double factor_ = 1.0;
  double difference_ = 0.0;
  std::function<double(double)> spring_sees_;
};

}  // namespace

Specification specify(const Frame& frame, const DriveModel& model) {
  if (!frame.has(Equation::torsion)) {
    return {std::nullopt,
            {"there is no model.toml: a model file holds the torsion law, which needs a torque "
             "across the transmission"}};
  }
  return Specifier(frame, model).specify();
}

}  // namespace flexspline::studies
