#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "flexspline/core/effect.hpp"

namespace flexspline {

/// A cos(w t + k) terms added up, with exact derivatives, over whole periods of 1 s: the last
/// sample closes the last cycle.
inline Motion harmonic_motion(const std::vector<double>& amplitudes, int samples_per_cycle,
                              int cycles = 1) {
  Motion m;
  for (int i = 0; i <= samples_per_cycle * cycles; ++i) {
    const double t = static_cast<double>(i) / samples_per_cycle;
    double x = 0.0;
    double v = 0.0;
    double a = 0.0;
    for (std::size_t k = 0; k < amplitudes.size(); ++k) {
      const double w = 2.0 * std::numbers::pi * static_cast<double>(k + 1);
      const double angle = w * t + static_cast<double>(k);
      x += amplitudes[k] * std::cos(angle);
      v -= w * amplitudes[k] * std::sin(angle);
      a -= w * w * amplitudes[k] * std::cos(angle);
    }
    m.time.push_back(t);
    m.position.push_back(x);
    m.velocity.push_back(v);
    m.acceleration.push_back(a);
  }
  return m;
}

/// Straight lines from turn to turn in steps of `step`, one sample a second.
inline Motion zigzag(const std::vector<double>& turns, double step) {
  Motion m;
  const auto add = [&m](double x, double v) {
    m.time.push_back(static_cast<double>(m.time.size()));
    m.position.push_back(x);
    m.velocity.push_back(v);
    m.acceleration.push_back(0.0);
  };
  add(turns.front(), 0.0);
  for (std::size_t k = 1; k < turns.size(); ++k) {
    const int count = static_cast<int>(std::lround(std::abs(turns[k] - turns[k - 1]) / step));
    const double signed_step = turns[k] > turns[k - 1] ? step : -step;
    for (int i = 1; i <= count; ++i) add(turns[k - 1] + i * signed_step, signed_step);
  }
  return m;
}

/// Work of a torque along a motion from one sample to another, trapezoids.
inline double work(const Motion& motion, const std::vector<double>& torque, std::size_t from,
                   std::size_t to) {
  double sum = 0.0;
  for (std::size_t i = from; i < to; ++i) {
    sum += 0.5 * (torque[i] + torque[i + 1]) * (motion.position[i + 1] - motion.position[i]);
  }
  return sum;
}

}  // namespace flexspline
