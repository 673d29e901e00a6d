#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "flexspline/core/effect.hpp"

namespace flexspline {

using Parameters = std::vector<std::pair<std::string, double>>;

/// Every field of an Instant, by name; gear_ratio is a constant of the bench and comes last.
template <class S>
struct InstantField {
  const char* name;
  S Instant<S>::*member;
  double scale;  ///< of what a 226 Nm unit of ratio 50 shows
};

template <class S>
constexpr auto instant_fields() {
  using X = Instant<S>;
  return std::to_array<InstantField<S>>(
      {{"time", &X::time, 30.0},
       {"motor_angle", &X::motor_angle, 3.0},
       {"motor_speed", &X::motor_speed, 30.0},
       {"motor_acceleration", &X::motor_acceleration, 300.0},
       {"load_angle", &X::load_angle, 1.0},
       {"load_speed", &X::load_speed, 0.6},
       {"load_acceleration", &X::load_acceleration, 6.0},
       {"torsion", &X::torsion, 2e-3},
       {"torsion_rate", &X::torsion_rate, 5e-3},
       {"torsion_acceleration", &X::torsion_acceleration, 0.1},
       {"transmitted_torque", &X::transmitted_torque, 100.0},
       {"transmitted_torque_rate", &X::transmitted_torque_rate, 1000.0},
       {"motor_torque", &X::motor_torque, 3.0},
       {"motor_torque_rate", &X::motor_torque_rate, 30.0},
       {"gear_ratio", &X::gear_ratio, 50.0}});
}

inline Parameters nominal_parameters(const EffectRow& row) {
  Parameters list;
  for (const auto& one : row.parameters) list.emplace_back(one.name, one.nominal);
  return list;
}

/// Nominal values times 0.7 to 1.4, within the bounds; around a nominal 0, up to a tenth. Two
/// elements where they repeat.
inline std::vector<double> scattered_parameters(const EffectRow& row, std::mt19937_64& draw) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<double> values;
  for (int element = 0; element < (row.repeats ? 2 : 1); ++element) {
    for (const auto& one : row.parameters) {
      const double value =
          one.nominal == 0.0 ? 0.1 * unit(draw) : one.nominal * std::exp2(0.5 * unit(draw));
      values.push_back(std::clamp(value, one.lower, one.upper));
    }
  }
  return values;
}

/// Sums of cosines, angle and its first three derivatives.
struct Wave {
  std::vector<double> amplitudes;
  double phase = 0.0;

  double derivative(int order, double t, double w) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < amplitudes.size(); ++k) {
      const double rate = w * static_cast<double>(k + 1);
      const double shift = phase + static_cast<double>(k) + 0.5 * std::numbers::pi * order;
      sum += amplitudes[k] * std::pow(rate, order) * std::cos(rate * t + shift);
    }
    return sum;
  }
};

/// A closed path of a whole drive of ratio 50: angles, torques and their derivatives belong
/// together, motor/50 - load = torsion, and all comes back after each period.
inline std::vector<Instant<double>> drive_path(double period, int samples_per_cycle, int cycles) {
  const Wave motor{{3.0, 1.0, 0.4}, 0.2};
  const Wave torsion{{2e-3, 1e-3, 5e-4}, 1.1};
  const Wave effort{{90.0, 40.0, 10.0}, 0.9};
  const double w = 2.0 * std::numbers::pi / period;
  std::vector<Instant<double>> path;
  for (int i = 0; i <= samples_per_cycle * cycles; ++i) {
    Instant<double> x;
    const double t = period * static_cast<double>(i) / samples_per_cycle;
    x.time = t;
    x.gear_ratio = 50.0;
    x.motor_angle = motor.derivative(0, t, w);
    x.motor_speed = motor.derivative(1, t, w);
    x.motor_acceleration = motor.derivative(2, t, w);
    x.torsion = torsion.derivative(0, t, w);
    x.torsion_rate = torsion.derivative(1, t, w);
    x.torsion_acceleration = torsion.derivative(2, t, w);
    x.load_angle = x.motor_angle / x.gear_ratio - x.torsion;
    x.load_speed = x.motor_speed / x.gear_ratio - x.torsion_rate;
    x.load_acceleration = x.motor_acceleration / x.gear_ratio - x.torsion_acceleration;
    x.transmitted_torque = effort.derivative(0, t, w);
    x.transmitted_torque_rate = effort.derivative(1, t, w);
    x.motor_torque = x.transmitted_torque / x.gear_ratio + 1e-3 * x.motor_acceleration;
    x.motor_torque_rate =
        x.transmitted_torque_rate / x.gear_ratio + 1e-3 * motor.derivative(3, t, w);
    path.push_back(x);
  }
  return path;
}

/// An instant at random, every field between a twentieth of its scale and its scale, either sign.
inline Instant<double> random_instant(std::mt19937_64& draw) {
  std::uniform_real_distribution<double> size(0.05, 1.0);
  Instant<double> x;
  for (const auto& field : instant_fields<double>()) {
    x.*field.member = field.scale * size(draw) * (draw() % 2 == 0 ? 1.0 : -1.0);
  }
  x.time = std::abs(x.time);
  x.gear_ratio = std::abs(x.gear_ratio);
  return x;
}

/// Where an instant goes within dt at constant accelerations and torque rates, to first order.
inline Instant<double> moved(Instant<double> x, double dt) {
  x.time += dt;
  x.motor_angle += dt * x.motor_speed;
  x.motor_speed += dt * x.motor_acceleration;
  x.load_angle += dt * x.load_speed;
  x.load_speed += dt * x.load_acceleration;
  x.torsion += dt * x.torsion_rate;
  x.torsion_rate += dt * x.torsion_acceleration;
  x.transmitted_torque += dt * x.transmitted_torque_rate;
  x.motor_torque += dt * x.motor_torque_rate;
  return x;
}

/// States that the effect gets into along a drive's path, drawn back from where elements slip.
inline std::vector<double> random_states(const EffectRow& row, std::span<const double> parameters,
                                         std::mt19937_64& draw) {
  static const auto path = drive_path(1.0, 400, 1);
  std::vector<double> states(state_count(row, parameters.size()), 0.0);
  if (row.real.advance == nullptr) return states;
  const std::size_t last = 50 + draw() % 350;
  for (std::size_t i = 1; i <= last; ++i) {
    row.real.advance(path[i - 1], path[i], parameters, states);
  }
  std::uniform_real_distribution<double> shrink(0.3, 0.9);
  for (double& state : states) state *= shrink(draw);
  return states;
}

}  // namespace flexspline
