#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "flexspline/data/hidden_bench.hpp"

namespace flexspline::data {

/// A drawn gear under a design that is short, and dense enough for differences of its samples.
inline HiddenBench small_bench(Rig rig, std::uint64_t seed = 3) {
  HiddenBench bench = draw_hidden_bench(rig, seed);
  bench.nuisances = {};
  if (rig == Rig::locked) bench.gear.motor_coulomb_speed *= 5.0;  // reversals that samples resolve
  const double torsion = bench.gear.rated_torsion;
  const auto sine = HiddenMotion::sine;
  const auto multisine = HiddenMotion::multisine;
  switch (rig) {
    case Rig::locked:
    case Rig::specimen:
      bench.design = {{sine, torsion, 0.03, 2.5, 500},
                      {sine, 0.6 * torsion, 1.5, 2.5, 500},
                      {multisine, torsion, 0.05, 1.5, 700}};
      break;
    case Rig::free:
      bench.design = {{sine, 0.3, 0.9, 2.5, 900},
                      {sine, 0.15, 1.4, 2.5, 700},
                      {multisine, 0.2, 0.25, 1.0, 1000}};
      break;
    case Rig::servo:
      bench.design = {{sine, 1.0, 0.2, 2.5, 800}, {sine, 0.4, 0.5, 2.5, 600}};
      break;
  }
  return bench;
}

/// A series of a recording with its differences of fourth order, away from the ends.
struct Differences {
  std::vector<double> value;
  double step = 0.0;

  double first(std::size_t k) const {
    return (8.0 * (value[k + 1] - value[k - 1]) - (value[k + 2] - value[k - 2])) / (12.0 * step);
  }
  double second(std::size_t k) const {
    return (16.0 * (value[k + 1] + value[k - 1]) - (value[k + 2] + value[k - 2]) -
            30.0 * value[k]) /
           (12.0 * step * step);
  }
};

inline Differences series(const Recording& r, Quantity quantity) {
  return {r.channels.at(quantity), r.time[1] - r.time[0]};
}

inline double coulomb(const HiddenGear& gear, double speed) {
  return gear.motor_coulomb * speed / std::hypot(speed, gear.motor_coulomb_speed);
}

/// phi of the encoders, or of the specimen.
inline Differences torsion_series(const HiddenBench& bench, const Recording& r) {
  if (bench.rig == Rig::specimen) return series(r, Quantity::torsion);
  Differences phi = series(r, Quantity::motor_angle);
  for (std::size_t k = 0; k < phi.value.size(); ++k) {
    phi.value[k] /= bench.gear.gear_ratio;
    if (bench.rig == Rig::free) phi.value[k] -= r.channels.at(Quantity::load_angle)[k];
  }
  return phi;
}

/// Balance of one equation at the samples that have differences, Nm, by the true laws.
inline std::vector<double> balance(const HiddenBench& bench, HiddenEquation equation,
                                   const Recording& r) {
  const HiddenGear& gear = bench.gear;
  std::vector<double> left;
  const bool motor = equation == HiddenEquation::motor;
  const Differences x = equation == HiddenEquation::torsion
                            ? torsion_series(bench, r)
                            : series(r, motor ? Quantity::motor_angle : Quantity::load_angle);
  const std::vector<double>& tau = r.channels.at(Quantity::transmitted_torque);
  for (std::size_t k = 2; k + 2 < tau.size(); ++k) {
    const double rate = x.first(k);
    if (equation == HiddenEquation::torsion) {
      left.push_back(tau[k] - gear.stiffness(x.value[k]) -
                     gear.damping(rate / gear.modulation(x.value[k])));
    } else if (motor) {
      left.push_back(r.channels.at(Quantity::motor_torque)[k] - tau[k] / gear.gear_ratio -
                     gear.motor_inertia * x.second(k) - gear.motor_drag * rate -
                     coulomb(gear, rate));
    } else {
      left.push_back(tau[k] - gear.load_inertia * x.second(k) - gear.load_drag * rate);
    }
  }
  return left;
}

inline double largest(const std::vector<double>& values) {
  double peak = 0.0;
  for (const double value : values) peak = std::max(peak, std::abs(value));
  return peak;
}

/// Largest imbalance over the set, share of the equation's peak torque. The drive has no balance of
/// its own on a compliant servo: it is held against the run without effects.
inline double imbalance(const HiddenBench& bench, HiddenEquation equation,
                        const HiddenDataset& data, const HiddenDataset& null_data) {
  const bool output = equation == HiddenEquation::torsion || equation == HiddenEquation::load;
  const double peak = output ? data.answer.peak_torque : data.answer.peak_motor_torque;
  double most = 0.0;
  for (std::size_t i = 0; i < data.ideal.recordings.size(); ++i) {
    const Recording& r = data.ideal.recordings[i];
    if (equation != HiddenEquation::drive) {
      most = std::max(most, largest(balance(bench, equation, r)));
      continue;
    }
    std::vector<double> gap = r.channels.at(Quantity::motor_torque);
    const auto& without = null_data.ideal.recordings[i].channels.at(Quantity::motor_torque);
    for (std::size_t k = 0; k < gap.size(); ++k) gap[k] -= without[k];
    most = std::max(most, largest(gap));
  }
  return most / peak;
}

/// The equations whose channels a rig records.
inline std::vector<HiddenEquation> equations_of(Rig rig) {
  using enum HiddenEquation;
  if (rig == Rig::locked) return {torsion, motor};
  if (rig == Rig::free) return {torsion, load, motor};
  if (rig == Rig::specimen) return {torsion};
  return {drive};
}

/// Same bits in every channel of every recording.
inline bool same_bits(const RecordingSet& a, const RecordingSet& b) {
  if (a.recordings.size() != b.recordings.size()) return false;
  for (std::size_t i = 0; i < a.recordings.size(); ++i) {
    const Recording& x = a.recordings[i];
    const Recording& y = b.recordings[i];
    if (x.id != y.id || x.start_s != y.start_s || x.time != y.time || x.channels != y.channels) {
      return false;
    }
  }
  return true;
}

}  // namespace flexspline::data
