#include "diagnosis/model/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

Columns of_torsion(Equation, const Frame& f, const Reference&, Values) {
  return {f.torsion_acceleration};
}

std::vector<Shape> lag(const Frame& f) {
  return {{.name = "time_constant",
           .unit = "s",
           .lower = 0.02 / f.fastest(),
           .upper = f.longest_lag(),
           .meaning = "in which it follows or settles"}};
}

// An inertia that a damped joint carries along.
Columns following(Equation, const Frame& f, const Reference&, Values shape) {
  return {f.filtered(f.torsion_acceleration, shape[0])};
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

Counterpart as_inertia(const FittedCause& c) {
  return {.effects = {{"inertia_torque", {{"inertia", c.coefficients[0]}}}}};
}

Counterpart as_carried(const FittedCause& c) {
  return {.effects = {{"carried_inertia",
                       {{"inertia", c.coefficients[0]}, {"time_constant", c.shape[0]}}}}};
}

Counterpart at_load(const FittedCause& c) { return {.load_inertia = c.coefficients[0]}; }

Counterpart at_motor(const FittedCause& c) { return {.motor_inertia = c.coefficients[0]}; }

constexpr std::string_view kNotOfLoad =
    "the catalogue of effects has an inertia before the sensor only where the torsion moves it";

std::vector<Term> terms(const Frame&) {
  return {{"inertia", "kg m2",
           "what moves between the spring and the sensor, or beside what is stated"}};
}

}  // namespace

CauseRow describe_inertia_torque() {
  return {.id = "inertia_torque",
          .coordinate = "acceleration",
          .forms = {{.equation = "tau_measured = tau + J phi''",
                     .rigs = {Rig::locked, Rig::specimen},
                     .at = {Equation::torsion},
                     .terms = terms,
                     .columns = of_torsion,
                     .nonnegative = true,
                     .unbounded = true,
                     .counterpart = as_inertia},
                    {.equation = "tau_measured = tau + J q_l'', T q_l' + q_l = q",
                     .rigs = {Rig::specimen},
                     .at = {Equation::torsion},
                     .shapes = lag,
                     .terms = terms,
                     .columns = following,
                     .nonnegative = true,
                     .unbounded = true,
                     .extends = true,
                     .where = travels,
                     .counterpart = as_carried},
                    {.equation = "tau_measured = tau + J theta_l''",
                     .rigs = {Rig::free},
                     .at = {Equation::torsion, Equation::load, Equation::motor},
                     .terms = terms,
                     .columns = before_sensor,
                     .no_counterpart = kNotOfLoad},
                    {.equation = "tau_L += J theta_l''",
                     .rigs = {Rig::free},
                     .at = {Equation::load},
                     .terms = terms,
                     .columns = of_load,
                     .stated = &Frame::load_inertia,
                     .counterpart = at_load},
                    {.equation = "tau_f += J theta_m''",
                     .rigs = kDrives,
                     .at = {Equation::motor},
                     .terms = terms,
                     .columns = of_motor,
                     .stated = &Frame::motor_inertia,
                     .counterpart = at_motor}}};
}

}  // namespace flexspline::studies
