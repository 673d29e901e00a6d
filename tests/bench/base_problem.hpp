#pragma once

#include <cmath>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include "flexspline/core/recording.hpp"

namespace flexspline::bench {

/// The base problem of the peers' benchmark: 5 amplitudes x 5 frequencies, three cycles from rest,
/// 1000 samples a loop, f and g of three terms, ln h of two, noise of 0.5 % of each loop's peak.
/// Motion in 0.2 deg, torque in 20 Nm. The draw of the noise is our own.
inline constexpr double kTruth[] = {1.0, 0.5, 0.25, 8.0, 12.0, 20.0, 0.4, -0.15};
inline constexpr double kCycles = 3.0;

inline double base_rate(double torque, double x) {
  const double x2 = x * x;
  const double u = torque - ((kTruth[2] * x2 + kTruth[1]) * x2 + kTruth[0]) * x;
  const double u2 = u * u;
  return std::exp((kTruth[7] * x2 + kTruth[6]) * x2) *
         ((kTruth[5] * u2 + kTruth[4]) * u2 + kTruth[3]) * u;
}

/// Four steps of the classical formula between two samples.
inline std::vector<double> base_motion(double amplitude, double frequency, int samples) {
  constexpr int kParts = 4;
  const double h = kCycles / frequency / samples / kParts;
  const auto torque = [&](double t) {
    return amplitude * std::sin(2.0 * std::numbers::pi * frequency * t);
  };
  std::vector<double> motion = {0.0};
  double x = 0.0;
  for (int step = 0; step < samples * kParts; ++step) {
    const double t = step * h;
    const double k1 = base_rate(torque(t), x);
    const double k2 = base_rate(torque(t + 0.5 * h), x + 0.5 * h * k1);
    const double k3 = base_rate(torque(t + 0.5 * h), x + 0.5 * h * k2);
    const double k4 = base_rate(torque(t + h), x + h * k3);
    x += h / 6.0 * (k1 + 2.0 * (k2 + k3) + k4);
    if (step % kParts == kParts - 1) motion.push_back(x);
  }
  return motion;
}

inline TorsionRecord base_record(double amplitude, double frequency, int samples,
                                 std::mt19937_64& engine) {
  TorsionRecord record;
  record.motion = base_motion(amplitude, frequency, samples);
  double peak = 0.0;
  for (const double x : record.motion) peak = std::max(peak, std::abs(x));
  std::normal_distribution<double> noise(0.0, 0.005 * peak);
  for (std::size_t i = 0; i < record.motion.size(); ++i) {
    if (i > 0) record.motion[i] += noise(engine);
    record.time.push_back(kCycles / frequency / samples * static_cast<double>(i));
    record.effort.push_back(amplitude *
                            std::sin(2.0 * std::numbers::pi * frequency * record.time.back()));
  }
  record.valid.assign(record.time.size(), true);
  record.amplitude = peak;
  record.frequency_hz = frequency;
  return record;
}

/// steps x steps loops over the same range; one loop is the largest and fastest.
inline std::vector<TorsionRecord> base_records(int steps = 5, int samples = 1000) {
  std::mt19937_64 engine(1);
  std::vector<TorsionRecord> records;
  for (int a = 1; a <= steps; ++a) {
    for (int f = 1; f <= steps; ++f) {
      const double share = steps > 1 ? (a - 1.0) / (steps - 1.0) : 1.0;
      const double octave = steps > 1 ? (f - 1.0) / (steps - 1.0) : 1.0;
      records.push_back(
          base_record(0.3 + 1.2 * share, 0.1 * std::pow(20.0, octave), samples, engine));
      records.back().id = std::to_string(a) + "/" + std::to_string(f);
    }
  }
  return records;
}

}  // namespace flexspline::bench
