#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "bench/table_one.hpp"
#include "flexspline/data/bench.hpp"

namespace flexspline::data {

/// A smooth stand-in for Table I that is strictly monotone everywhere. Its natural units are those
/// of the paper's operating point: x = phi / 0.2 deg, z = (phi'/h) / (0.2 deg * 2 pi 0.005/s).

/// f = 4.81 x + 11.77 x^3 Nm.
inline double smooth_stiffness(double phi) {
  const double x = phi / kPaperAmplitude;
  return (4.81 + 11.77 * x * x) * x;
}

/// g^-1 = 6.155 z (0.067 + 0.933 |z| / sqrt(1 + z^2)) Nm: nearly quadratic, with linear tails.
inline double smooth_damping(double speed) {
  constexpr double kSlope = 979.6 * kPaperSpeed / kRadPerDeg;  // Nm per unit of z
  constexpr double kFloor = 0.067;
  const double z = speed / kPaperSpeed;
  return kSlope * z * (kFloor + (1.0 - kFloor) * std::abs(z) / std::sqrt(1.0 + z * z));
}

inline double no_modulation(double) { return 0.0; }
inline double no_damping(double) { return 0.0; }

/// ln h = 0.3 x^2.
inline double even_modulation(double phi) {
  const double x = phi / kPaperAmplitude;
  return 0.3 * x * x;
}

/// ln h = 0.3 x^2 + 0.15 x.
inline double even_odd_modulation(double phi) {
  return even_modulation(phi) + 0.15 * phi / kPaperAmplitude;
}

/// 15 % more than smooth_damping forwards, 15 % less backwards.
inline double asymmetric_damping(double speed) {
  return smooth_damping(speed) * (speed > 0.0 ? 1.15 : 0.85);
}

/// x^2 * 1 Nm on top of smooth_stiffness: 6 % of its edge value.
inline double asymmetric_stiffness(double phi) {
  const double x = phi / kPaperAmplitude;
  return smooth_stiffness(phi) + x * x;
}

/// 0.8 Nm at the paper's amplitude and frequency: 5 % of the peak.
inline constexpr double kBenchInertia = 0.8 / (kPaperAmplitude * kPaperRate * kPaperRate);

/// 0.03 rad of the paper's cycle: 1.7 deg.
inline constexpr double kBenchLag = 0.03 / kPaperRate;

/// 3 % third and 2 % second harmonic.
inline std::vector<std::pair<int, std::pair<double, double>>> bench_harmonics() {
  return {{3, {0.03, 0.7}}, {2, {0.02, 0.4}}};
}

/// The base with h = 1 and a perfect bench.
inline BenchTruth smooth_base() {
  BenchTruth truth;
  truth.stiffness = smooth_stiffness;
  truth.damping = smooth_damping;
  truth.log_modulation = no_modulation;
  return truth;
}

}  // namespace flexspline::data
