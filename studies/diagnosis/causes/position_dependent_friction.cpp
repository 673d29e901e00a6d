#include <cmath>

#include "diagnosis/frame/coordinates.hpp"
#include "diagnosis/model/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

// Once and twice a turn of the wave generator.
Columns turns(const ArrayXd& angle, const ArrayXd& sign) {
  Columns columns = sine_pair(angle, 1.0, sign);
  for (ArrayXd& column : sine_pair(angle, 2.0, sign)) columns.push_back(std::move(column));
  return columns;
}

Columns at_motor(Equation, const Frame& f, const Reference& known, Values) {
  return turns(f.motor_angle, known.motor_sign);
}

bool ripples(double order) { return order == 1.0 || order == 2.0; }

Columns at_joint(Equation, const Frame& f, const Reference& known, Values) {
  return turns(f.motor_angle, rounded_sign(f.torsion_rate, known.torsion_sign));
}

void add_wave(EffectSpec& effect, double order, double sine, double cosine, double width) {
  for (const auto& [name, value] : {std::pair("order", order), std::pair("sine", sine),
                                    std::pair("cosine", cosine), std::pair("smoothing", width)}) {
    effect.parameters.emplace_back(name, value);
  }
}

// Sine and cosine by turn, over an angle that is that many times the effect's own.
void add_turns(EffectSpec& effect, const Eigen::VectorXd& a, double ratio, const SignPart& sign) {
  for (Eigen::Index k = 0; k < 2; ++k) {
    add_wave(effect, ratio * (static_cast<double>(k) + 1.0), sign.share * a[2 * k],
             sign.share * a[2 * k + 1], sign.width);
  }
}

Counterpart motor_waves(const FittedCause& c) {
  EffectSpec effect{"position_dependent_friction", {}};
  for (const SignPart& part : c.motor_sign) add_turns(effect, c.coefficients, 1.0, part);
  return {.effects = {std::move(effect)}};
}

Counterpart joint_waves(const FittedCause& c) {
  EffectSpec effect{"position_dependent_friction", {}};
  for (const SignPart& part : c.torsion_sign)
    add_turns(effect, c.coefficients, c.frame.ratio, part);
  return {.effects = {std::move(effect)}};
}

std::vector<Term> turn_terms(const Frame&) {
  return {{"sine_1", "Nm", "of the friction once a turn of the motor"},
          {"cosine_1", "Nm", "its cosine"},
          {"sine_2", "Nm", "of the friction twice a turn"},
          {"cosine_2", "Nm", "its cosine"}};
}

}  // namespace

CauseRow describe_position_dependent_friction() {
  return {.id = "position_dependent_friction",
          .coordinate = "motor_angle",
          .forms = {
              {.equation = "tau_f += sum_k (a_k sin k theta_m + b_k cos k theta_m) sgn w, k = 1, 2",
               .rigs = kTurning,
               .at = {Equation::motor},
               .terms = turn_terms,
               .columns = at_motor,
               .where = geared,
               .counterpart = motor_waves},
              {.equation = "tau += sum_k (a_k sin k N q + b_k cos k N q) sgn q', k = 1, 2",
               .rigs = {Rig::specimen},
               .at = {Equation::torsion},
               .terms = turn_terms,
               .columns = at_joint,
               .where = travels,
               .ripples = ripples,
               .counterpart = joint_waves}}};
}

}  // namespace flexspline::studies
