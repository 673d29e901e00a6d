#include "diagnosis/model/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

constexpr int kElements = 9;

std::vector<double> gear_yields(const Frame& f) {
  const double from = f.travels ? 5e-4 : 0.01;
  const double to = f.travels ? 0.1 : 0.7;
  return geometric(from * f.torsion_range, to * f.torsion_range, kElements);
}

// The motor travels far: what slips before it slides is a small part of a turn.
std::vector<double> motor_yields(const Frame& f) {
  const double range = f.motor_angle.abs().maxCoeff();
  return geometric(1e-4 * range, 0.3 * range, kElements);
}

Columns across(Equation, const Frame& f, const Reference&, Values) {
  return stop_operators(f, f.torsion, gear_yields(f));
}

Columns at_motor(Equation, const Frame& f, const Reference&, Values) {
  return stop_operators(f, f.motor_angle, motor_yields(f));
}

Counterpart springs_that_slip(const FittedCause& c, std::span<const double> yields) {
  EffectSpec effect{"presliding_hysteresis", {}};
  for (std::size_t k = 0; k < yields.size(); ++k) {
    const double stiffness = c.coefficients[static_cast<Eigen::Index>(k)];
    if (!(stiffness > 0.0)) continue;
    effect.parameters.emplace_back("stiffness", stiffness);
    effect.parameters.emplace_back("yield", yields[k]);
  }
  if (effect.parameters.empty()) return {};
  return {.effects = {std::move(effect)}};
}

// The same springs, at the motor's angle (which an angle that travels is); no Stribeck peak, so
// that lag and speed have nothing to say.
Counterpart springs_that_travel(const FittedCause& c, std::span<const double> yields) {
  EffectSpec effect{"gms_friction", {}};
  for (std::size_t k = 0; k < yields.size(); ++k) {
    const double stiffness = c.coefficients[static_cast<Eigen::Index>(k)];
    if (!(stiffness > 0.0)) continue;
    for (const auto& [name, value] :
         {std::pair("stiffness", stiffness), std::pair("yield", yields[k]),
          std::pair("excess", 0.0), std::pair("stribeck_speed", 1.0), std::pair("lag", 1e-3)}) {
      effect.parameters.emplace_back(name, value);
    }
  }
  if (effect.parameters.empty()) return {};
  return {.effects = {std::move(effect)}};
}

Counterpart in_the_gear(const FittedCause& c) {
  const auto yields = gear_yields(c.frame);
  return c.frame.travels ? springs_that_travel(c, yields) : springs_that_slip(c, yields);
}

Counterpart in_the_motor(const FittedCause& c) {
  return springs_that_travel(c, motor_yields(c.frame));
}

Term element() {
  return {"stiffness",
          "Nm/rad",
          "of a spring that slips",
          "yield",
          0.0,
          "rad",
          "way after which it slips; of a fixed grid"};
}

std::vector<Term> gear_terms(const Frame& f) { return elements(gear_yields(f), element()); }

std::vector<Term> motor_terms(const Frame& f) { return elements(motor_yields(f), element()); }

}  // namespace

CauseRow describe_presliding_hysteresis() {
  return {.id = "presliding_hysteresis",
          .coordinate = "reversal_memory",
          .forms = {{.equation = "tau += sum_i k_i s_i, s_i' = phi' unless |s_i| = r_i",
                     .rigs = kAnyRig,
                     .at = {Equation::torsion},
                     .terms = gear_terms,
                     .columns = across,
                     .nonnegative = true,
                     .friction = true,
                     .counterpart = in_the_gear},
                    {.equation = "tau_f += sum_i k_i s_i, s_i' = theta_m' unless |s_i| = r_i",
                     .rigs = kMotors,
                     .at = {Equation::motor},
                     .terms = motor_terms,
                     .columns = at_motor,
                     .nonnegative = true,
                     .counterpart = in_the_motor}}};
}

}  // namespace flexspline::studies
