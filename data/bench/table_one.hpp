#pragma once

#include <array>
#include <cstddef>
#include <numbers>

namespace flexspline::data {

inline constexpr double kRadPerDeg = std::numbers::pi / 180.0;

/// The paper's operating point: 10 deg at the motor over a gear ratio of 50, at 0.005 Hz.
inline constexpr double kPaperGearRatio = 50.0;
inline constexpr double kPaperAmplitude = 0.2 * kRadPerDeg;                     ///< rad
inline constexpr double kPaperFrequency = 0.005;                                ///< Hz
inline constexpr double kPaperRate = 2.0 * std::numbers::pi * kPaperFrequency;  ///< rad/s
inline constexpr double kPaperSpeed = kPaperAmplitude * kPaperRate;             ///< rad/s
inline constexpr double kPaperPeakTorque = 16.54;                               ///< Nm, of Table I

/// Table I of Dhaouadi and Ghorbel (2003), phi in deg: Nm/deg^(2i-1) and Nm/(deg/s)^(2i-1).
inline constexpr std::array<double, 5> kTableOneStiffness = {14.133, 3.71e3, -1.471e5, 3.778e6,
                                                             -3.370e7};
inline constexpr std::array<double, 5> kTableOneDamping = {65.594, 5.571e7, -2.485e12, 5.615e16,
                                                           -4.673e20};

/// sum c_i x^(2i-1), by Horner's rule.
inline double odd_polynomial(const std::array<double, 5>& c, double x) {
  double sum = 0.0;
  for (std::size_t i = c.size(); i-- > 0;) sum = sum * x * x + c[i];
  return sum * x;
}

/// f of Table I in Nm at phi in rad. Rising up to 118 % of 0.2 deg only.
inline double table_one_stiffness(double phi) {
  return odd_polynomial(kTableOneStiffness, phi / kRadPerDeg);
}

/// g^-1 of Table I in Nm at phi' in rad/s. Rising up to 113.5 % of 0.2 deg * 2 pi 0.005/s only.
inline double table_one_damping(double speed) {
  return odd_polynomial(kTableOneDamping, speed / kRadPerDeg);
}

}  // namespace flexspline::data
