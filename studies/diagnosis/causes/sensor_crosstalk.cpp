#include "diagnosis/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

Columns twice_a_turn(Equation equation, const Frame& f, const Reference&, Values) {
  return of_torque_signal(equation, f, sine_pair(f.motor_angle, 2.0));
}

}  // namespace

CauseRow describe_sensor_crosstalk() {
  return {.id = "sensor_crosstalk",
          .coordinate = "motor_angle",
          .forms = {{.equation = "tau_measured = tau + a sin(2 theta_m + p)",
                     .rigs = {Rig::free},
                     .at = {Equation::torsion, Equation::load, Equation::motor},
                     .columns = twice_a_turn}}};
}

}  // namespace flexspline::studies
