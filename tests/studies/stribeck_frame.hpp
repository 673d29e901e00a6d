#pragma once

#include <random>

#include "drive_frame.hpp"

namespace flexspline::studies {

constexpr double kStribeckNoise = 0.004;    // Nm
constexpr double kStribeckCoulomb = 0.05;   // Nm
constexpr double kStribeckExcess = 0.25;    // Nm
constexpr double kStribeckFalls = 0.15;     // Stribeck speed over the largest
constexpr double kStribeckRounding = 0.01;  // width of the sign over the same

/// The sign of that friction, all rows.
inline Eigen::ArrayXd stribeck_sign(const Frame& frame) {
  return (frame.motor_speed / (kStribeckRounding * frame.speed_range)).tanh();
}

/// The torque of the motor, before noise, Nm.
inline Eigen::ArrayXd stribeck_torque(const Frame& f) {
  const Eigen::ArrayXd w = f.motor_speed / f.speed_range;
  const Eigen::ArrayXd magnitude =
      kStribeckCoulomb + kStribeckExcess * (-(w / kStribeckFalls).square()).exp();
  return f.motor_inertia * f.motor_acceleration + f.torque / f.ratio + 0.1 * w +
         magnitude * stribeck_sign(f);
}

/// The motor's equation alone of a closed-form drive, with a friction at rest six times that in
/// motion.
inline Frame stribeck_frame() {
  Frame f = closed_form_frame();
  f.equations = {Equation::motor};
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, kStribeckNoise);
  f.motor_torque =
      stribeck_torque(f) + Eigen::ArrayXd::NullaryExpr(f.rows(), [&] { return noise(random); });
  return f;
}

}  // namespace flexspline::studies
