#pragma once

#include <cmath>
#include <numbers>
#include <random>

#include "flexspline/core/recording.hpp"

namespace flexspline {

/// A sine of 1 Hz and amplitude 2 with effort = law(x, v), start at the middle.
template <class EffortLaw>
TorsionRecord sine_record(double cycles, int per_cycle, EffortLaw law) {
  TorsionRecord record;
  record.id = "sine";
  const int count = static_cast<int>(cycles * per_cycle);
  for (int i = 0; i <= count; ++i) {
    const double t = static_cast<double>(i) / per_cycle;
    const double w = 2.0 * std::numbers::pi;
    const double x = 2.0 * std::sin(w * t);
    const double v = 2.0 * w * std::cos(w * t);
    record.time.push_back(t);
    record.motion.push_back(x);
    record.effort.push_back(law(x, v));
  }
  record.valid.assign(record.time.size(), true);
  return record;
}

inline void add_noise(std::vector<double>& samples, double deviation, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal(0.0, deviation);
  for (double& y : samples) y += normal(engine);
}

}  // namespace flexspline
