#include "diagnosis/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

std::vector<Shape> steep(const Frame&) {
  return {{.name = "exponent", .unit = "1", .lower = 1.25, .upper = 4.0, .grid = 4}};
}

std::vector<Shape> flat(const Frame&) {
  return {{.name = "exponent", .unit = "1", .lower = 0.25, .upper = 0.8, .grid = 4}};
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

}  // namespace

CauseRow describe_nonlinear_viscous_friction() {
  const auto form = [](std::string_view equation, std::vector<Rig> rigs, Equation at, auto shapes,
                       auto columns) {
    return CauseForm{.equation = equation,
                     .rigs = std::move(rigs),
                     .at = {at},
                     .shapes = shapes,
                     .columns = columns,
                     .nonnegative = true,
                     .travels_only = true};
  };
  return {
      .id = "nonlinear_viscous_friction",
      .coordinate = "velocity",
      .forms = {form("tau_f += c |w|^n sgn w", kDrives, Equation::motor, steep, at_motor),
                form("tau_f += c |w|^n sgn w", kDrives, Equation::motor, flat, at_motor),
                form("tau_L += c |w_l|^n sgn w_l", {Rig::free}, Equation::load, steep, at_load),
                form("tau_L += c |w_l|^n sgn w_l", {Rig::free}, Equation::load, flat, at_load),
                form("tau += c |q'|^n sgn q'", {Rig::specimen}, Equation::torsion, steep, across),
                form("tau += c |q'|^n sgn q'", {Rig::specimen}, Equation::torsion, flat, across)}};
}

}  // namespace flexspline::studies
