#include "diagnosis/model/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

std::vector<Shape> delay(const Frame& f) {
  const double most = 0.5 / f.fastest();
  return {{.name = "delay",
           .unit = "s",
           .lower = -most,
           .upper = most,
           .logarithmic = false,
           .meaning = "by which it is late"}};
}

// Early, a motor torque would be one that follows itself: what a filter of it explains as well.
std::vector<Shape> late(const Frame& f) {
  auto shapes = delay(f);
  shapes[0].lower = 0.0;
  return shapes;
}

std::vector<Shape> long_delay(const Frame& f) {
  auto shapes = delay(f);
  shapes[0].lower *= 2.0;
  shapes[0].upper *= 2.0;
  return shapes;
}

std::vector<double> small(const Frame& f) { return {0.01 / f.fastest()}; }

// A torque that is late shows the motion of d ago, which may be long against a reversal.
void motion_of_then(Frame& f, Values shape) {
  for (ArrayXd* motion : {&f.torsion, &f.torsion_rate, &f.torsion_acceleration, &f.motor_angle,
                          &f.motor_speed, &f.load_angle}) {
    *motion = later(f, *motion, -shape[0]);
  }
}

// A filter of first order behind a delay.
std::vector<Shape> delay_and_lag(const Frame& f) {
  auto shapes = long_delay(f);
  shapes.push_back({.name = "time_constant",
                    .unit = "s",
                    .lower = 0.0,
                    .upper = f.longest_lag(),
                    .logarithmic = false,
                    .meaning = "in which it follows or settles"});
  return shapes;
}

std::vector<double> small_both(const Frame& f) { return {0.01 / f.fastest(), 0.1 / f.fastest()}; }

void behind_a_filter(Frame& f, Values shape) {
  motion_of_then(f, shape);
  f.torque_lag += shape[1];
}

// Of a drive torsion and load are compared with it as they were d ago, and the motor feels what it
// shows d later. Of that as much as the torsion tells: a smoothed torque keeps some of a noise that
// has a colour, and what is moved against itself is less.
void drive_of_then(Frame& f, Values shape) {
  const double d = shape[0];
  f.motor_torque -= (later(f, f.told_torque, d) - f.told_torque) / f.ratio;
  f.torsion += -d * f.torsion_rate + 0.5 * d * d * f.torsion_acceleration;
  f.torsion_rate -= d * f.torsion_acceleration;
  f.load_speed -= d * f.load_acceleration;
  f.load_acceleration = later(f, f.load_acceleration, -d);
}

void motor_torque_late(Frame& f, Values shape) { f.motor_torque += shape[0] * f.motor_torque_rate; }

Counterpart torque_late(const FittedCause& c) {
  return {.effects = {{"sensor_delay", {{"delay", c.shape[0]}}}}};
}

Counterpart torque_late_and_filtered(const FittedCause& c) {
  return {.effects = {{"sensor_delay", {{"delay", c.shape[0]}}},
                      {"torque_sensor_lag", {{"time_constant", c.shape[1]}}}}};
}

constexpr std::string_view kNotAtMotor =
    "the catalogue of effects delays the torque sensor, not the motor torque";

}  // namespace

CauseRow describe_sensor_delay() {
  return {.id = "sensor_delay",
          .coordinate = "lag",
          .forms = {{.equation = "tau_measured(t) = tau(t - d)",
                     .rigs = {Rig::specimen},
                     .at = {Equation::torsion},
                     .shapes = long_delay,
                     .transform = motion_of_then,
                     .start = small,
                     .counterpart = torque_late},
                    {.equation = "T tau_measured' + tau_measured = tau(t - d)",
                     .rigs = {Rig::specimen},
                     .at = {Equation::torsion},
                     .shapes = delay_and_lag,
                     .transform = behind_a_filter,
                     .start = small_both,
                     .extends = true,
                     .where = travels,
                     .counterpart = torque_late_and_filtered},
                    {.equation = "tau_measured(t) = tau(t - d)",
                     .rigs = kDrives,
                     .at = {Equation::torsion, Equation::load, Equation::motor},
                     .shapes = delay,
                     .transform = drive_of_then,
                     .start = small,
                     .counterpart = torque_late},
                    {.equation = "tau_m,recorded(t) = tau_m(t - d)",
                     .rigs = kDrives,
                     .at = {Equation::motor},
                     .shapes = late,
                     .transform = motor_torque_late,
                     .start = small,
                     .no_counterpart = kNotAtMotor}}};
}

}  // namespace flexspline::studies
