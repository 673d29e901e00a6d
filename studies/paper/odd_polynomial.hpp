#pragma once

#include <array>
#include <vector>

namespace flexspline::studies {

/// c1 x + c2 x^3 + … + c5 x^9, as published: arguments in deg or deg/s, values in Nm.
struct OddPolynomial {
  std::array<double, 5> coefficients{};

  double value(double x) const;
  double slope(double x) const;
  /// Sum of |terms| over |sum of terms|: what cancellation costs at x.
  double cancellation(double x) const;
  /// Positive zeros of the value and of the slope, ascending; by the companion matrix in x^2.
  std::vector<double> zeros() const;
  std::vector<double> slope_zeros() const;
};

/// Table I of Dhaouadi and Ghorbel (2003).
inline constexpr OddPolynomial kStiffness{{14.133, 3.71e3, -1.471e5, 3.778e6, -3.370e7}};
inline constexpr OddPolynomial kDamping{{65.594, 5.571e7, -2.485e12, 5.615e16, -4.673e20}};

inline constexpr double kAmplitudeDeg = 0.2;  ///< 10 deg at the motor, ratio 50
inline constexpr double kFrequencyHz = 0.005;
inline constexpr double kOmega = 2.0 * 3.14159265358979323846 * kFrequencyHz;
inline constexpr double kSpeedDeg = kAmplitudeDeg * kOmega;  ///< deg/s
inline constexpr double kRatedTorque = 226.0;                ///< Nm, Table II
inline constexpr double kGearRatio = 50.0;
inline constexpr double kWaveGeneratorInertia = 0.436e-3;  ///< kg m2, unit is our reading
inline constexpr double kMotorInertia = 0.29e-3;           ///< kg m2

}  // namespace flexspline::studies
