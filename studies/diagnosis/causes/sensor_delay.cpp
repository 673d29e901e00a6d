#include "diagnosis/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

std::vector<Shape> delay(const Frame& f) {
  const double most = 0.5 / fastest(f);
  return {{.name = "delay", .unit = "s", .lower = -most, .upper = most, .logarithmic = false}};
}

std::vector<double> small(const Frame& f) { return {0.01 / fastest(f)}; }

// A torque that is late shows the motion of d ago.
void motion_of_then(Frame& f, Values shape) {
  const double d = shape[0];
  f.torsion += -d * f.torsion_rate + 0.5 * d * d * f.torsion_acceleration;
  f.torsion_rate -= d * f.torsion_acceleration;
}

// The smooth part as it is d later, with the noise of the sample itself.
void torque_of_now(Frame& f, Values shape) {
  f.torque += later(f, f.smooth_torque, shape[0]) - f.smooth_torque;
}

void motor_torque_late(Frame& f, Values shape) { f.motor_torque += shape[0] * f.motor_torque_rate; }

Counterpart torque_late(const FittedCause& c) {
  return {.effects = {{"sensor_delay", {{"delay", c.shape[0]}}}}};
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
                     .shapes = delay,
                     .transform = motion_of_then,
                     .start = small,
                     .wound_only = true,
                     .counterpart = torque_late},
                    {.equation = "tau_measured(t) = tau(t - d)",
                     .rigs = kDrives,
                     .at = {Equation::torsion, Equation::load, Equation::motor},
                     .shapes = delay,
                     .transform = torque_of_now,
                     .start = small,
                     .counterpart = torque_late},
                    {.equation = "tau_m,recorded(t) = tau_m(t - d)",
                     .rigs = kDrives,
                     .at = {Equation::motor},
                     .shapes = delay,
                     .transform = motor_torque_late,
                     .start = small,
                     .no_counterpart = kNotAtMotor}}};
}

}  // namespace flexspline::studies
