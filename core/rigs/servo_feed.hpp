#pragma once

#include "rigs/rig_parts.hpp"

namespace flexspline {

/// What a servo's motor is fed with. winding: a voltage, through the inductance; position_loop: the
/// voltage that the servo's own proportional loop asks for.
enum class Feed { torque, current, voltage, winding, position_loop };

/// Without the channel drive_enabled a drive is on.
inline bool enabled(const RigInputs& inputs, double t) {
  const auto found = inputs.channels.find(Quantity::drive_enabled);
  return found == inputs.channels.end() || found->second.value(t) >= 0.5;
}

inline double voltage(const RigInputs& inputs, double t) {
  return input(inputs, Quantity::duty_cycle).value(t) *
         input(inputs, Quantity::supply_voltage).value(t);
}

/// Of a loop with the gain of the inputs, whose bridge is full at a duty cycle of one.
template <class S>
S loop_voltage(const RigInputs& inputs, const S& angle, double t) {
  const double supply = input(inputs, Quantity::supply_voltage).value(t);
  const S duty =
      inputs.position_gain->value(t) * (input(inputs, Quantity::commanded_angle).value(t) - angle);
  if (real_part(duty) > 1.0) return S(supply);
  if (real_part(duty) < -1.0) return S(-supply);
  return supply * duty;
}

/// The motor's torque; a drive that is off carries no current. Not through the winding, whose
/// current is a state.
template <class S>
S fed_torque(const DriveAt<S>& at, const RigInputs& inputs, Feed feed, const Instant<S>& x,
             double t) {
  if (!enabled(inputs, t)) return S(0.0);
  if (feed == Feed::torque) return S(input(inputs, Quantity::motor_torque).value(t));
  const S kt = at.constant(&DriveSpec::torque_constant);
  if (feed == Feed::current) return S(kt * input(inputs, Quantity::current).value(t));
  const S emf = at.constant(&DriveSpec::back_emf) * x.motor_speed;
  const S fed =
      feed == Feed::position_loop ? loop_voltage(inputs, x.load_angle, t) : S(voltage(inputs, t));
  return kt * (fed - emf) / at.constant(&DriveSpec::resistance);
}

/// L i' = V - R i - ke omega; off, the current decays through the bridge.
template <class S>
S winding_rate(const DriveAt<S>& at, const RigInputs& inputs, const Instant<S>& x, double t,
               const S& current) {
  const S drop = at.constant(&DriveSpec::resistance) * current;
  const S inductance = at.constant(&DriveSpec::inductance);
  if (!enabled(inputs, t)) return -drop / inductance;
  const S emf = at.constant(&DriveSpec::back_emf) * x.motor_speed;
  return (voltage(inputs, t) - drop - emf) / inductance;
}

}  // namespace flexspline
