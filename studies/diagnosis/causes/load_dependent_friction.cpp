#include "diagnosis/frame/coordinates.hpp"
#include "diagnosis/model/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

Columns at_motor(Equation, const Frame& f, const Reference& known, Values) {
  return {smooth_torque(f, known).abs() / f.ratio * known.motor_sign};
}

Columns across(Equation, const Frame& f, const Reference& known, Values) {
  return {known.elastic.abs() * rounded_sign(f.torsion_rate, known.torsion_sign)};
}

// Beyond a small part of the range it would be a spring's.
std::vector<double> yields_of(const Frame& f) {
  return geometric(0.003 * f.torsion_range, 0.05 * f.torsion_range, 4);
}

// Its sign has a memory: it turns over the first yields of the way back, at any speed.
Columns across_with_memory(Equation, const Frame& f, const Reference& known, Values) {
  const auto yields = yields_of(f);
  Columns c = stop_operators(f, f.torsion, yields);
  for (std::size_t k = 0; k < yields.size(); ++k) c[k] *= known.elastic.abs() / yields[k];
  return c;
}

std::vector<EffectSpec> friction_by(const FittedCause& c, std::span<const SignPart> sign) {
  return by_sign_part(sign, "load_dependent_friction", [&](double share, double width) {
    return std::vector<std::pair<std::string, double>>{
        {"coefficient", share * c.coefficients[0]},
        {"smoothing", width},
        {"load_smoothing", 1e-6 * c.frame.torque_range}};
  });
}

Counterpart motor_friction(const FittedCause& c) {
  return {.effects = friction_by(c, c.motor_sign)};
}

constexpr std::string_view kOfAllTorque =
    "it goes with the torque transmitted, not with f alone, and so is larger by the dissipative "
    "torque's share";

Counterpart gear_friction(const FittedCause& c) {
  return {.effects = friction_by(c, c.torsion_sign), .caveat = std::string(kOfAllTorque)};
}

Counterpart gear_friction_with_memory(const FittedCause& c) {
  const auto yields = yields_of(c.frame);
  EffectSpec effect{"presliding_load_friction", {}};
  for (std::size_t k = 0; k < yields.size(); ++k) {
    const double coefficient = c.coefficients[static_cast<Eigen::Index>(k)];
    if (!(coefficient > 0.0)) continue;
    effect.parameters.emplace_back("coefficient", coefficient);
    effect.parameters.emplace_back("yield", yields[k]);
    effect.parameters.emplace_back("load_smoothing", 1e-6 * c.frame.torque_range);
  }
  if (effect.parameters.empty()) return {};
  return {.effects = {std::move(effect)}, .caveat = std::string(kOfAllTorque)};
}

std::vector<Term> terms(const Frame&) {
  return {{"coefficient", "1", "friction over the torque that loads it"}};
}

std::vector<Term> terms_with_memory(const Frame& f) {
  return elements(yields_of(f), {"coefficient", "1", "share of friction over load that slips there",
                                 "yield", 0.0, "rad", "way after which it slips; of a fixed grid"});
}

}  // namespace

CauseRow describe_load_dependent_friction() {
  return {
      .id = "load_dependent_friction",
      .coordinate = "load",
      .forms = {{.equation = "tau_f += mu |tau|/N sgn w",
                 .rigs = kMotors,
                 .at = {Equation::motor},
                 .terms = terms,
                 .columns = at_motor,
                 .nonnegative = true,
                 .counterpart = motor_friction},
                {.equation = "tau += mu |f(phi)| sgn phi'",
                 .rigs = {Rig::locked, Rig::specimen},
                 .at = {Equation::torsion},
                 .terms = terms,
                 .columns = across,
                 .nonnegative = true,
                 .friction = true,
                 .counterpart = gear_friction},
                {.equation = "tau += |f(phi)| sum_i mu_i s_i/r_i, s_i' = phi' unless |s_i| = r_i",
                 .rigs = {Rig::locked, Rig::specimen},
                 .at = {Equation::torsion},
                 .terms = terms_with_memory,
                 .columns = across_with_memory,
                 .nonnegative = true,
                 .friction = true,
                 .where = wound_up,
                 .counterpart = gear_friction_with_memory}}};
}

}  // namespace flexspline::studies
