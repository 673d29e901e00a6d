#include "diagnosis/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

Columns at_motor(Equation, const Frame& f, const Reference& known, Values) {
  return {known.motor_sign.square(), f.motor_speed.abs() / f.speed_range};
}

Columns across(Equation, const Frame& f, const Reference& known, Values) {
  return {known.dissipative.abs(), f.torsion_rate.abs() / f.rate_range};
}

}  // namespace

CauseRow describe_direction_asymmetry() {
  return {.id = "direction_asymmetry",
          .coordinate = "velocity",
          .forms = {{.equation = "tau_f += d tanh^2(w/w_e) + b |w|",
                     .rigs = kDrives,
                     .at = {Equation::motor},
                     .columns = at_motor},
                    {.equation = "tau += d |g^-1(phi'/h)| + b |phi'|",
                     .rigs = kAnyRig,
                     .at = {Equation::torsion},
                     .columns = across}}};
}

}  // namespace flexspline::studies
