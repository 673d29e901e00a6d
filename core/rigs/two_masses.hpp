#pragma once

#include "rigs/enter_transmission.hpp"

namespace flexspline {

/// Motor and load as states theta_m, omega_m, theta_l, omega_l have them.
template <class S>
Instant<S> two_masses(const DriveModel& model, double t, std::span<const S> y) {
  Instant<S> x;
  x.time = S(t);
  x.gear_ratio = model.drive().gear_ratio;
  x.motor_angle = y[0];
  x.motor_speed = y[1];
  x.load_angle = y[2];
  x.load_speed = y[3];
  x.torsion = y[0] / x.gear_ratio - y[2];
  x.torsion_rate = y[1] / x.gear_ratio - y[3];
  return x;
}

/// Eqs. (5) and (6), with what the kinematics return to both shafts. rigid: the instant without
/// them, as enter_transmission gives it.
template <class S>
void accelerate(const DriveAt<S>& at, const RigInputs& inputs, Instant<S>& x,
                const Instant<S>& rigid, double t) {
  const S geared = x.transmitted_torque / x.gear_ratio + at.motor_reaction(rigid, x);
  const S motor = x.motor_torque - at.motor_losses(x) - geared;
  S load(x.transmitted_torque - at.load_reaction(rigid, x) - at.load_torque(x));
  if (inputs.load_torque) load -= S(inputs.load_torque->value(t));
  x.motor_acceleration = motor / at.constant(&DriveSpec::motor_inertia);
  x.load_acceleration = load / at.constant(&DriveSpec::load_inertia);
  x.torsion_acceleration = x.motor_acceleration / x.gear_ratio - x.load_acceleration;
}

}  // namespace flexspline
