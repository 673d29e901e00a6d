#include "diagnosis/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

std::vector<Shape> shapes(std::string_view name, double range) {
  return {{.name = name,
           .unit = "rad/s",
           .lower = 0.003 * range,
           .upper = 0.6 * range,
           .grid = 6,
           .meaning = "at which the excess has fallen to 1/e"},
          {.name = "exponent", .unit = "1", .lower = 0.5, .upper = 3.0, .meaning = "of the speed"}};
}

std::vector<Shape> motor_speed(const Frame& f) { return shapes("stribeck_speed", f.speed_range); }
std::vector<Shape> rate(const Frame& f) { return shapes("stribeck_rate", f.rate_range); }

// Below the first width a sign is as good as abrupt, above the last it is a drag.
std::vector<Shape> rate_and_width(const Frame& f) {
  auto list = rate(f);
  list.push_back({.name = "width",
                  .unit = "rad/s",
                  .lower = 1e-3 * f.rate_range,
                  .upper = 0.1 * f.rate_range,
                  .meaning = "over which it turns its sign, or around zero torque"});
  return list;
}

ArrayXd fading(const ArrayXd& speed, Values shape) {
  return (-(speed.abs() / shape[0]).pow(shape[1])).exp();
}

Columns at_motor(Equation, const Frame& f, const Reference& known, Values shape) {
  return {fading(f.motor_speed, shape) * known.motor_sign};
}

Columns across(Equation, const Frame& f, const Reference& known, Values shape) {
  return {fading(f.torsion_rate, shape) * rounded_sign(f.torsion_rate, known.torsion_coulomb_rate)};
}

Columns across_rounded(Equation, const Frame& f, const Reference&, Values shape) {
  return {fading(f.torsion_rate, shape) * rounded_sign(f.torsion_rate, shape[2])};
}

Counterpart motor_peak(const FittedCause& c) {
  return {.effects = by_sign_part(c, "stribeck_friction", [&](double share, double width) {
            return std::vector<std::pair<std::string, double>>{
                {"excess", share * c.coefficients[0]},
                {"stribeck_speed", c.shape[0]},
                {"exponent", c.shape[1]},
                {"smoothing", width}};
          })};
}

Counterpart gear_peak(const FittedCause& c) {
  const double width = c.shape.size() > 2 ? c.shape[2] : c.torsion_coulomb_rate;
  return {.effects = {{"stribeck_friction",
                       {{"excess", c.coefficients[0]},
                        {"stribeck_speed", c.shape[0]},
                        {"exponent", c.shape[1]},
                        {"smoothing", width}}}}};
}

std::vector<Term> terms(const Frame&) {
  return {{"excess", "Nm", "of the friction at rest over that in motion"}};
}

CauseForm form(std::string_view equation, Equation at, decltype(CauseForm::columns) columns) {
  const bool motor = at == Equation::motor;
  return {.equation = equation,
          .rigs = motor ? kMotors : kAnyRig,
          .at = {at},
          .shapes = motor ? motor_speed : rate,
          .terms = terms,
          .columns = columns,
          .nonnegative = true,
          .friction = !motor,
          .counterpart = motor ? motor_peak : gear_peak};
}

// The sign rounded off by its own width, which a friction across the gear need not share with g^-1.
CauseForm rounded_form() {
  return {.equation = "tau += s exp(-|phi'/v_s|^d) tanh(phi'/v_w)",
          .rigs = {Rig::specimen},
          .at = {Equation::torsion},
          .shapes = rate_and_width,
          .terms = terms,
          .columns = across_rounded,
          .nonnegative = true,
          .friction = true,
          .extends = true,
          .counterpart = gear_peak};
}

}  // namespace

CauseRow describe_stribeck_friction() {
  return {.id = "stribeck_friction",
          .coordinate = "velocity",
          .forms = {form("tau_f += s exp(-|w/w_s|^d) sgn w", Equation::motor, at_motor),
                    form("tau += s exp(-|phi'/v_s|^d) sgn phi'", Equation::torsion, across),
                    rounded_form()}};
}

}  // namespace flexspline::studies
