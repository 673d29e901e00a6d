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

}  // namespace

CauseRow describe_load_dependent_friction() {
  return {.id = "load_dependent_friction",
          .coordinate = "load",
          .forms = {{.equation = "tau_f += mu |tau|/N sgn w",
                     .rigs = kDrives,
                     .at = {Equation::motor},
                     .columns = at_motor,
                     .nonnegative = true},
                    {.equation = "tau += mu |f(phi)| sgn phi'",
                     .rigs = {Rig::locked, Rig::specimen},
                     .at = {Equation::torsion},
                     .columns = across,
                     .nonnegative = true}}};
}

}  // namespace flexspline::studies
