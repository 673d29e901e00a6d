#include <algorithm>

#include "diagnosis/frame/coordinates.hpp"
#include "diagnosis/model/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

Columns at_motor(Equation, const Frame& f, const Reference& known, Values) {
  return {known.motor_sign.square(), f.motor_speed.abs() / f.speed_range};
}

Columns across(Equation, const Frame& f, const Reference& known, Values) {
  return {known.friction.abs(), f.torsion_rate.abs() / f.rate_range};
}

std::vector<Shape> width(const Frame& f) {
  return {{.name = "width",
           .unit = "rad/s",
           .lower = 1e-3 * f.rate_range,
           .upper = 0.2 * f.rate_range,
           .meaning = "over which it turns its sign, or around zero torque"}};
}

// A difference of dry friction alone, whatever else g^-1 is made of.
Columns dry_across(Equation, const Frame& f, const Reference&, Values shape) {
  return {rounded_sign(f.torsion_rate, shape[0]).square(), f.torsion_rate.abs() / f.rate_range};
}

// The square of a sign that saturates over several widths is that over the widest's only nearly.
Counterpart motor_halves(const FittedCause& c) {
  Counterpart counterpart;
  if (c.motor_sign.empty()) return counterpart;
  const auto main = std::ranges::max_element(c.motor_sign, {}, &SignPart::share);
  counterpart.effects = {{"direction_asymmetry",
                          {{"coulomb_difference", c.coefficients[0]},
                           {"viscous_difference", c.coefficients[1] / c.frame.speed_range},
                           {"smoothing", main->width}}}};
  if (c.motor_sign.size() > 1) {
    counterpart.caveat = "its sign saturates over one speed, the fitted one over several";
  }
  return counterpart;
}

Counterpart gear_halves(const FittedCause& c) {
  Counterpart counterpart{
      .effects = {{"direction_asymmetry",
                   {{"coulomb_difference", c.coefficients[0] * c.slipping},
                    {"viscous_difference", c.coefficients[1] / c.frame.rate_range},
                    {"smoothing", c.slipping > 0.0
                                      ? std::ranges::max(c.torsion_sign, {}, &SignPart::share).width
                                      : 1e-6 * c.frame.rate_range}}}},
      .side_difference = c.coefficients[0]};
  if (c.slipping > 0.0) {
    counterpart.caveat =
        "the difference of what slips builds up with the way, in the model file with the speed";
  }
  return counterpart;
}

Counterpart dry_halves(const FittedCause& c) {
  return {.effects = {{"direction_asymmetry",
                       {{"coulomb_difference", c.coefficients[0]},
                        {"viscous_difference", c.coefficients[1] / c.frame.rate_range},
                        {"smoothing", c.shape[0]}}}}};
}

std::vector<Term> dry_terms(const Frame&) {
  return {
      {"coulomb_difference", "Nm", "half the difference of dry friction between the directions"},
      {"viscous_difference", "Nm", "half that of viscous friction at the largest speed"}};
}

std::vector<Term> share_terms(const Frame&) {
  return {
      {"difference", "1", "half the difference of friction between the directions, a share of it"},
      {"viscous_difference", "Nm", "half that of viscous friction at the largest rate"}};
}

}  // namespace

CauseRow describe_direction_asymmetry() {
  return {.id = "direction_asymmetry",
          .coordinate = "velocity",
          .forms = {{.equation = "tau_f += d tanh^2(w/w_e) + b |w|",
                     .rigs = kMotors,
                     .at = {Equation::motor},
                     .terms = dry_terms,
                     .columns = at_motor,
                     .counterpart = motor_halves},
                    {.equation = "tau += d |tau_friction| + b |phi'|",
                     .rigs = kAnyRig,
                     .at = {Equation::torsion},
                     .terms = share_terms,
                     .columns = across,
                     .counterpart = gear_halves},
                    {.equation = "tau += d tanh^2(phi'/v_w) + b |phi'|",
                     .rigs = {Rig::specimen},
                     .at = {Equation::torsion},
                     .shapes = width,
                     .terms = dry_terms,
                     .columns = dry_across,
                     .counterpart = dry_halves}}};
}

}  // namespace flexspline::studies
