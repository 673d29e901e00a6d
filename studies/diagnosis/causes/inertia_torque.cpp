#include "diagnosis/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

Columns of_torsion(Equation, const Frame& f, const Reference&, Values) {
  return {f.torsion_acceleration};
}

Columns of_load(Equation, const Frame& f, const Reference&, Values) {
  return {f.load_acceleration};
}

Columns of_motor(Equation, const Frame& f, const Reference&, Values) {
  return {f.motor_acceleration};
}

Columns before_sensor(Equation equation, const Frame& f, const Reference&, Values) {
  return of_torque_signal(equation, f, {f.load_acceleration});
}

}  // namespace

CauseRow describe_inertia_torque() {
  return {.id = "inertia_torque",
          .coordinate = "acceleration",
          .forms = {{.equation = "tau_measured = tau + J phi''",
                     .rigs = {Rig::locked, Rig::specimen},
                     .at = {Equation::torsion},
                     .columns = of_torsion,
                     .nonnegative = true},
                    {.equation = "tau_measured = tau + J theta_l''",
                     .rigs = {Rig::free},
                     .at = {Equation::torsion, Equation::load, Equation::motor},
                     .columns = before_sensor},
                    {.equation = "tau_L += J theta_l''",
                     .rigs = {Rig::free},
                     .at = {Equation::load},
                     .columns = of_load},
                    {.equation = "tau_f += J theta_m''",
                     .rigs = kDrives,
                     .at = {Equation::motor},
                     .columns = of_motor}}};
}

}  // namespace flexspline::studies
