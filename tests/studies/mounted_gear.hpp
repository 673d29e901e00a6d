#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>

#include "flexspline/core/recording.hpp"
#include "flexspline/core/stop_operator.hpp"
#include "numbered_sine.hpp"

namespace flexspline::studies {

/// A gear wound up under sines of its output, mounted anew for every recording.
struct MountedGear {
  double stiffness = 800.0;                ///< Nm/rad
  double half_gap = 0.0;                   ///< rad
  double friction = 0.6;                   ///< Nm, without load
  double load_share = 0.0;                 ///< friction over the elastic torque
  std::vector<double> zeros = {0.0, 0.0};  ///< rad, by mounting
  double noise = 0.02;                     ///< Nm

  double elastic(double x) const { return stiffness * (x - std::clamp(x, -half_gap, half_gap)); }

  Recording recording(double amplitude, double frequency, double zero, unsigned seed) const {
    Recording r = numbered_sine(amplitude, frequency, seed);
    std::mt19937 random(seed);
    std::normal_distribution<double> error(0.0, noise);
    std::normal_distribution<double> jitter(0.0, 1e-6);
    constexpr double kYield = 3e-4;
    StopOperator stop(kYield);
    double last = 0.0;
    for (int i = 0; i < 2400; ++i) {
      const double t = 3.0 / frequency * i / 2400.0;
      const double x = amplitude * std::sin(2.0 * std::numbers::pi * frequency * t);
      const double turned = stop.advance(x - last) / kYield;
      last = x;
      r.time.push_back(t);
      r.channels[Quantity::torsion].push_back(x + zero + jitter(random));
      r.channels[Quantity::torque].push_back(
          elastic(x) + (friction + load_share * std::abs(elastic(x))) * turned + error(random));
    }
    return r;
  }

  RecordingSet recordings() const {
    RecordingSet set;
    set.name = "gear";
    set.rig = Rig::specimen;
    unsigned seed = 1;
    for (const double zero : zeros) {
      for (const double amplitude : {0.006, 0.012, 0.02}) {
        for (const double frequency : {0.1, 0.3}) {
          set.recordings.push_back(recording(amplitude, frequency, zero, seed++));
        }
      }
    }
    return set;
  }
};

}  // namespace flexspline::studies
