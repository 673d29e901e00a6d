#include "diagnosis/model/specification.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "diagnosis/frame/baseline.hpp"
#include "diagnosis/model/cancelling.hpp"
#include "diagnosis/model/law_fit.hpp"
#include "diagnosis/model/rig_constants.hpp"
#include "flexspline/core/effect.hpp"

namespace flexspline::studies {
namespace {

using Eigen::Index;

constexpr double kLeft = 0.2;          // of the smaller of two parts, as in a fit
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

/// Puts the causes of a model into effects, one after another.
class Specifier {
 public:
  Specifier(const Frame& frame, const DriveModel& model, const std::vector<std::string>& remarks)
      : frame_(frame),
        model_(model),
        remarks_(remarks),
        seen_(seen_by_the_laws(frame, model)),
        reference_(reference_of(frame, model)) {
    if (frame.has(Equation::torsion)) {
      slipping_ = (reference_.friction - reference_.dissipative).abs().maxCoeff();
    }
    if (frame.has(Equation::motor)) sign_ = sign_parts(seen_, reference_.motor_sign);
  }

  Specification specify() {
    const auto refused = cancelling(frame_, model_, reference_, kLeft);
    for (const Cancelling& pair : refused) say("model.toml lacks {}", in_words(model_, pair));
    std::vector<std::size_t> taken;
    for (std::size_t i = 0; i < model_.causes.size(); ++i) {
      if (std::ranges::none_of(refused, [&](const Cancelling& pair) { return pair.has(i); }))
        taken.push_back(i);
    }
    constants_ = rig_constants(seen_, model_, gains_of(taken));
    rig_ = {frame_.rig, constants_.drive};
    for (const std::size_t i : taken) add(i);
    put_laws();
    mark_origin(frame_, rig_);
    return {std::move(rig_), std::move(notes_)};
  }

 private:
  template <class... Args>
  void say(fmt::format_string<Args...> text, Args&&... args) {
    notes_.push_back(fmt::format(text, std::forward<Args>(args)...));
  }

  ModelSpec& spec() { return rig_.drive.torsion; }

  void leave_out(const ActiveCause& cause, std::string_view why) {
    say("model.toml lacks {} ({}): {}", cause.row->id, cause.form->equation, why);
  }

  void add(std::size_t i) {
    const ActiveCause& cause = model_.causes[i];
    const CauseForm& form = *cause.form;
    if (form.counterpart == nullptr) {
      leave_out(cause, form.no_counterpart.empty() ? "the catalogue of effects has nothing like it"
                                                   : form.no_counterpart);
      return;
    }
    Counterpart counterpart = counterpart_of(cause, model_.coefficients[i]);
    if (!form.rescales && !of_torque_sensor(counterpart)) {
      counterpart =
          counterpart_of(cause, constants_.in_torque(seen_, cause, first_equation(frame_, form),
                                                     model_.coefficients[i], reference_));
    }
    for (const EffectSpec& effect : counterpart.effects) {
      const std::string why = out_of_range(effect);
      if (why.empty()) continue;
      leave_out(cause, why);
      return;
    }
    if (!add_inertia(cause, counterpart)) return;
    if (i < remarks_.size() && !remarks_[i].empty()) {
      for (EffectSpec& effect : counterpart.effects) effect.note = remarks_[i];
      say("model.toml holds {}: {}", cause.row->id, remarks_[i]);
    }
    take(cause, std::move(counterpart));
  }

  Counterpart counterpart_of(const ActiveCause& cause, const Eigen::VectorXd& coefficients) const {
    return cause.form->counterpart(
        {seen_, cause.shape, coefficients, sign_, reference_.torsion_sign, slipping_});
  }

  /// Of the causes that correct a torque's gain, among those that stand in the file.
  TorqueGains gains_of(const std::vector<std::size_t>& taken) const {
    TorqueGains gains;
    for (const std::size_t i : taken) {
      const ActiveCause& cause = model_.causes[i];
      if (!cause.form->rescales || cause.form->counterpart == nullptr) continue;
      const Counterpart counterpart = counterpart_of(cause, model_.coefficients[i]);
      for (const EffectSpec& effect : counterpart.effects) {
        if (!out_of_range(effect).empty()) continue;
        take_gain(effect, gains);
      }
    }
    return gains;
  }

  /// False, and a note, where nothing would be left of an inertia.
  bool add_inertia(const ActiveCause& cause, const Counterpart& counterpart) {
    DriveSpec& drive = rig_.drive;
    const double motor = drive.motor_inertia + counterpart.motor_inertia;
    const double load = drive.load_inertia + counterpart.load_inertia;
    const bool motor_lost = counterpart.motor_inertia < 0.0 && !(motor > 0.0);
    if (motor_lost || (counterpart.load_inertia < 0.0 && !(load > 0.0))) {
      leave_out(cause, fmt::format("it would leave an inertia of {:.3g} kg m2",
                                   motor_lost ? motor : load));
      return false;
    }
    drive.motor_inertia = motor;
    drive.load_inertia = load;
    return true;
  }

  void take(const ActiveCause& cause, Counterpart counterpart) {
    if (!counterpart.caveat.empty()) say("model.toml: {}: {}", cause.row->id, counterpart.caveat);
    for (EffectSpec& effect : counterpart.effects) {
      effect.across = stands_across(cause, effect);
      spec().effects.push_back(std::move(effect));
    }
    factor_ *= counterpart.law_factor;
    difference_ += counterpart.side_difference;
    spring_difference_ += counterpart.spring_difference;
    if (counterpart.spring_sees) spring_sees_ = counterpart.spring_sees;
  }

  /// A friction of the torsion equation that the catalogue has at the motor.
  bool stands_across(const ActiveCause& cause, const EffectSpec& effect) const {
    const auto row = find_effect(effect.effect);
    return frame_.rig != Rig::specimen && row && (*row)->site == Site::motor &&
           first_equation(frame_, *cause.form) == Equation::torsion;
  }

  void put_laws() {
    if (!frame_.has(Equation::torsion)) {
      spec().f = spec().g_inverse = rigid_law();
      spec().h = {.law = "bounded_modulation", .scale = 1.0, .knots = {}, .coefficients = {}};
      return;
    }
    const Eigen::VectorXd& own = model_.own[index_of(Equation::torsion)];
    const auto columns = baseline_columns(seen_, Equation::torsion, model_.torsion_shape);
    if (frame_.travels) {
      put_travelling_laws(own, columns.elastic);
    } else {
      put_gear_laws(own, columns.elastic + columns.dissipative);
    }
    for (LawSpec* law : {&spec().f, &spec().g_inverse}) {
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
    spec().f = std::move(f.law);
    spec().g_inverse = std::move(g.law);
    spec().h = modulation_law(seen_, shape, range, spring_sees_);
    split_sides(spec().f, spring_difference_);
    split_sides(spec().g_inverse, difference_);
    if (shape[2] != 0.0 || frame_.zero != 0.0) {
      const double zero = frame_.zero + shape[2] * seen_.torsion_range;
      spec().effects.push_back({"torsion_zero", {{"zero", zero}}});
    }
    if (own.size() > laws)
      spec().effects.push_back({"torque_sensor_offset", {{"offset", own[laws]}}});
  }

  static void split_sides(LawSpec& law, double difference) {
    if (difference == 0.0) return;
    auto& both = law.coefficients;
    const std::vector<double> odd = both;
    for (double& c : both) c *= 1.0 + difference;
    for (double c : odd) both.push_back((1.0 - difference) * c);
  }

  // Dry friction as an effect, what grows with the rate as g^-1.
  void put_travelling_laws(const Eigen::VectorXd& own, Index travel) {
    if (difference_ != 0.0) {
      say("model.toml: direction_asymmetry: of dry friction both directions have the mean");
    }
    spec().f = {.law = "free_spline",
                .scale = 1.0,
                .knots = {seen_.torsion.minCoeff(), seen_.torsion.maxCoeff()},
                .coefficients = {own.begin(), own.begin() + travel},
                .valid_to = seen_.torsion_range};
    spec().g_inverse = {.law = "odd_polynomial",
                        .scale = seen_.rate_range,
                        .knots = {},
                        .coefficients = {own[own.size() - 1]},
                        .valid_to = seen_.rate_range};
    spec().h = {.law = "bounded_modulation", .scale = 1.0, .knots = {}, .coefficients = {}};
    const auto widths = dry_widths(seen_.rate_range);
    for (std::size_t k = 0; k < widths.size(); ++k) {
      const double coulomb = own[travel + static_cast<Index>(k)];
      if (!(coulomb > 0.0)) continue;
      spec().effects.push_back(
          {"coulomb_viscous_friction",
           {{"coulomb", coulomb}, {"viscous", 0.0}, {"smoothing", widths[k]}}});
    }
  }

  const Frame& frame_;
  const DriveModel& model_;
  const std::vector<std::string>& remarks_;
  Frame seen_;
  Reference reference_;
  RigConstants constants_;
  double slipping_ = 0.0;
  std::vector<SignPart> sign_;
  RigModel rig_;
  std::vector<std::string> notes_;
  double factor_ = 1.0;
  double difference_ = 0.0;
  double spring_difference_ = 0.0;
  std::function<double(double)> spring_sees_;
};

}  // namespace

Specification specify(const Frame& frame, const DriveModel& model,
                      const std::vector<std::string>& remarks) {
  return Specifier(frame, model, remarks).specify();
}

}  // namespace flexspline::studies
