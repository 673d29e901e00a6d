#include <cmath>

#include "diagnosis/model/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

std::vector<Shape> steep(const Frame&) {
  return {{.name = "exponent",
           .unit = "1",
           .lower = 1.25,
           .upper = 4.0,
           .grid = 4,
           .meaning = "of the speed"}};
}

std::vector<Shape> flat(const Frame&) {
  return {{.name = "exponent",
           .unit = "1",
           .lower = 0.25,
           .upper = 0.8,
           .grid = 4,
           .meaning = "of the speed"}};
}

ArrayXd power(const ArrayXd& speed, double exponent) {
  const ArrayXd u = speed / speed.abs().maxCoeff();
  return u.abs().pow(exponent) * u.sign();
}

Columns at_motor(Equation, const Frame& f, const Reference&, Values shape) {
  return {power(f.motor_speed, shape[0])};
}

Columns at_load(Equation, const Frame& f, const Reference&, Values shape) {
  return {power(f.load_speed, shape[0])};
}

Columns across(Equation, const Frame& f, const Reference&, Values shape) {
  return {power(f.torsion_rate, shape[0])};
}

Counterpart power_drag(const FittedCause& c, double fastest) {
  return {.effects = {{"nonlinear_viscous_friction",
                       {{"drag", c.coefficients[0] / std::pow(fastest, c.shape[0])},
                        {"exponent", c.shape[0]},
                        {"smoothing", 1e-6 * fastest}}}}};
}

Counterpart motor_drag(const FittedCause& c) {
  return power_drag(c, c.frame.motor_speed.abs().maxCoeff());
}

Counterpart travel_drag(const FittedCause& c) {
  return power_drag(c, c.frame.torsion_rate.abs().maxCoeff());
}

std::vector<Term> terms(const Frame&) {
  return {{"drag", "Nm", "at the largest speed, beyond the viscous one"}};
}

}  // namespace

CauseRow describe_nonlinear_viscous_friction() {
  const auto form = [](std::string equation, std::vector<Rig> rigs, Equation at, auto shapes,
                       auto columns, auto counterpart) {
    return CauseForm{.equation = std::move(equation),
                     .rigs = std::move(rigs),
                     .at = {at},
                     .shapes = shapes,
                     .terms = terms,
                     .columns = columns,
                     .nonnegative = true,
                     .where = travels,
                     .counterpart = counterpart,
                     .no_counterpart =
                         "the catalogue of effects has power laws at the motor, not "
                         "at the load"};
  };
  Counterpart (*const none)(const FittedCause&) = nullptr;
  return {.id = "nonlinear_viscous_friction",
          .coordinate = "velocity",
          .forms = {
              form("tau_f += c |w|^n sgn w", kMotors, Equation::motor, steep, at_motor, motor_drag),
              form("tau_f += c |w|^n sgn w", kMotors, Equation::motor, flat, at_motor, motor_drag),
              form("tau_L += c |w_l|^n sgn w_l", {Rig::free}, Equation::load, steep, at_load, none),
              form("tau_L += c |w_l|^n sgn w_l", {Rig::free}, Equation::load, flat, at_load, none),
              form("tau += c |q'|^n sgn q'", {Rig::specimen}, Equation::torsion, steep, across,
                   travel_drag),
              form("tau += c |q'|^n sgn q'", {Rig::specimen}, Equation::torsion, flat, across,
                   travel_drag)}};
}

}  // namespace flexspline::studies
