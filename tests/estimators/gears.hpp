#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "flexspline/core/effect.hpp"
#include "flexspline/core/law.hpp"
#include "flexspline/core/recording.hpp"
#include "flexspline/estimators/method.hpp"

namespace flexspline::estimators {

inline constexpr double kDegree = std::numbers::pi / 180.0;
/// The operating point of Dhaouadi and Ghorbel (2003): 0.2 deg at the output, 0.005 Hz.
inline constexpr double kAmplitude = 0.2 * kDegree;
inline constexpr double kFrequency = 0.005;
inline constexpr double kSpeed = kAmplitude * 2.0 * std::numbers::pi * kFrequency;
inline constexpr double kPeak = 16.5;  // Nm

inline const std::vector<double> kTableF = {14.133, 3.71e3, -1.471e5, 3.778e6, -3.370e7};
inline const std::vector<double> kTableG = {65.594, 5.571e7, -2.485e12, 5.615e16, -4.673e20};

inline double odd_polynomial(const std::vector<double>& c, double x) {
  double sum = 0.0;
  for (std::size_t k = c.size(); k-- > 0;) sum = sum * x * x + c[k];
  return sum * x;
}

/// A gear with known laws, displacement-driven by eq. (4).
struct Gear {
  std::function<double(double)> f;
  std::function<double(double)> g_inverse;
  std::function<double(double)> h = [](double) { return 1.0; };
  double inertia = 0.0;
  double delay = 0.0;
};

/// Table I, phi in deg.
inline Gear table_i() {
  return {.f = [](double x) { return odd_polynomial(kTableF, x / kDegree); },
          .g_inverse = [](double v) { return odd_polynomial(kTableG, v / kDegree); }};
}

/// Close to Table I and increasing everywhere.
inline Gear smooth_gear() {
  return {.f =
              [](double phi) {
                const double x = phi / kAmplitude;
                return (4.81 + 11.77 * x * x) * x;
              },
          .g_inverse =
              [](double speed) {
                const double z = speed / kSpeed;
                return 6.155 * z * (0.067 + 0.933 * std::abs(z) / std::sqrt(1.0 + z * z));
              }};
}

/// ln h = 0.3 (phi/0.2 deg)^2.
inline Gear gear_with_even_h() {
  Gear gear = smooth_gear();
  gear.h = [](double phi) { return std::exp(0.3 * std::pow(phi / kAmplitude, 2)); };
  return gear;
}

struct Loop {
  double amplitude = 1.0;  ///< in units of kAmplitude
  double frequency = 1.0;  ///< in units of kFrequency
  int cycles = 3;
  int per_cycle = 250;
  double noise = 0.0;  ///< of torque, in units of kPeak
  unsigned seed = 1;
};

/// A sine held from the first sample on.
inline TorsionRecord measured(const Gear& gear, const Loop& loop) {
  TorsionRecord record;
  record.id = fmt::format("a{:f}-f{:f}", loop.amplitude, loop.frequency);
  record.frequency_hz = loop.frequency * kFrequency;
  const double a = loop.amplitude * kAmplitude;
  const double w = 2.0 * std::numbers::pi * loop.frequency * kFrequency;
  std::mt19937_64 engine(loop.seed);
  std::normal_distribution<double> normal;
  for (int i = 0; i <= loop.cycles * loop.per_cycle; ++i) {
    const double t = 2.0 * std::numbers::pi / w * i / loop.per_cycle;
    const double angle = w * (t - gear.delay);
    const double x = a * std::sin(angle);
    const double v = a * w * std::cos(angle);
    const double torque = gear.f(x) + gear.g_inverse(v / gear.h(x)) - gear.inertia * w * w * x;
    record.time.push_back(t);
    record.motion.push_back(a * std::sin(w * t));
    record.effort.push_back(torque + loop.noise * kPeak * normal(engine));
  }
  record.valid.assign(record.time.size(), true);
  return record;
}

/// The motion of a record of the sine it was made of, without noise.
inline Motion motion_of(const TorsionRecord& record) {
  const double w = 2.0 * std::numbers::pi * *record.frequency_hz;
  const double a = *std::ranges::max_element(record.motion);
  Motion motion{.time = record.time, .position = record.motion, .velocity = {}, .acceleration = {}};
  for (double t : record.time) motion.velocity.push_back(a * w * std::cos(w * t));
  for (double x : record.motion) motion.acceleration.push_back(-w * w * x);
  return motion;
}

/// Two amplitudes at two frequencies.
inline std::vector<TorsionRecord> four_loops(const Gear& gear, Loop loop) {
  std::vector<TorsionRecord> records;
  for (double amplitude : {1.0, 0.6}) {
    for (double frequency : {1.0, 0.5}) {
      loop.amplitude = amplitude;
      loop.frequency = frequency;
      loop.seed = loop.seed * 31 + 7;
      records.push_back(measured(gear, loop));
    }
  }
  return records;
}

inline Result<Estimate> fitted(std::string_view method, std::vector<TorsionRecord> records,
                               Options options = {}) {
  const auto row = find_method(method);
  if (!row) return tl::unexpected(row.error());
  return (*row)->fit({.records = std::move(records), .options = std::move(options)});
}

/// Largest difference of a law from the truth over [-range, range], in units of the truth's
/// largest.
inline double worst_error(const LawSpec& spec, const std::function<double(double)>& truth,
                          double range) {
  const auto law = make_law(spec);
  double worst = 0.0;
  double largest = 0.0;
  for (double u = -1.0; u <= 1.0; u += 0.01) {
    worst = std::max(worst, std::abs((*law)->value(u * range) - truth(u * range)));
    largest = std::max(largest, std::abs(truth(u * range)));
  }
  return worst / largest;
}

/// Root mean square of the same.
inline double rms_error(const LawSpec& spec, const std::function<double(double)>& truth,
                        double range) {
  const auto law = make_law(spec);
  double sum = 0.0;
  double largest = 0.0;
  for (int k = -100; k <= 100; ++k) {
    const double x = 0.01 * k * range;
    sum += std::pow((*law)->value(x) - truth(x), 2) / 201.0;
    largest = std::max(largest, std::abs(truth(x)));
  }
  return std::sqrt(sum) / largest;
}

}  // namespace flexspline::estimators
