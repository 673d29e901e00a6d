#include "diagnosis/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

Columns at_motor(Equation, const Frame& f, const Reference& known, Values) {
  return {f.smooth_torque.abs() / f.ratio * known.motor_sign};
}

Columns across(Equation, const Frame& f, const Reference& known, Values) {
  return {known.elastic.abs() * rounded_sign(f.torsion_rate, known.torsion_coulomb_rate)};
}

Counterpart motor_friction(const FittedCause& c) {
  return {.effects = by_sign_part(c, "load_dependent_friction", [&](double share, double width) {
            return std::vector<std::pair<std::string, double>>{
                {"coefficient", share * c.coefficients[0]},
                {"smoothing", width},
                {"load_smoothing", 1e-6 * c.frame.torque_range}};
          })};
}

Counterpart gear_friction(const FittedCause& c) {
  return {.effects = {{"load_dependent_friction",
                       {{"coefficient", c.coefficients[0]},
                        {"smoothing", c.torsion_coulomb_rate},
                        {"load_smoothing", 1e-6 * c.frame.torque_range}}}},
          .caveat =
              "it goes with the torque transmitted, not with f alone, and so is larger by the "
              "dissipative torque's share"};
}

}  // namespace

CauseRow describe_load_dependent_friction() {
  return {.id = "load_dependent_friction",
          .coordinate = "load",
          .forms = {{.equation = "tau_f += mu |tau|/N sgn w",
                     .rigs = kMotors,
                     .at = {Equation::motor},
                     .columns = at_motor,
                     .nonnegative = true,
                     .counterpart = motor_friction},
                    {.equation = "tau += mu |f(phi)| sgn phi'",
                     .rigs = {Rig::locked, Rig::specimen},
                     .at = {Equation::torsion},
                     .columns = across,
                     .nonnegative = true,
                     .friction = true,
                     .counterpart = gear_friction}}};
}

}  // namespace flexspline::studies
