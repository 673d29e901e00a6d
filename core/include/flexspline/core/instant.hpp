#pragma once

namespace flexspline {

/// All that an effect may depend on at one instant. SI; motor quantities at the motor shaft, others
/// at the output. On a specimen the imposed motion is motor, load and torsion at once, with ratio
/// 1, and effort is the transmitted torque.
template <class S>
struct Instant {
  S time{0.0};
  S motor_angle{0.0};
  S motor_speed{0.0};
  S motor_acceleration{0.0};
  S load_angle{0.0};
  S load_speed{0.0};
  S load_acceleration{0.0};
  S torsion{0.0};
  S torsion_rate{0.0};
  S torsion_acceleration{0.0};
  S transmitted_torque{0.0};
  S transmitted_torque_rate{0.0};
  S motor_torque{0.0};
  S motor_torque_rate{0.0};
  S gear_ratio{1.0};
};

}  // namespace flexspline
