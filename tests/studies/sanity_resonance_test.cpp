// Two angles near a resonance, where the windup is as large as the motion.
#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "flexspline/data/sanity.hpp"
#include "flexspline/data/sanity_check.hpp"

namespace flexspline::studies {
namespace {

constexpr double kInertia = 3.0, kStiffness = 2e4;  // kg m2, Nm/rad: a resonance at 13 Hz

/// A free drive of ratio 100 whose load is driven at these frequencies, theta_m = N (theta_l +
/// J theta_l''/k), and what gear_ratio is stated to be.
RecordingSet driven_at(const std::vector<std::array<double, 2>>& frequencies, double stated) {
  RecordingSet set;
  set.rig = Rig::free;
  set.constants = {{"gear_ratio", stated}, {"load_inertia_kgm2", kInertia}};
  for (const auto& pair : frequencies) {
    Recording& r = set.recordings.emplace_back();
    r.id = std::to_string(pair[0]) + " Hz";
    r.start_s = 20.0 * static_cast<double>(set.recordings.size());
    for (double t = 0.0; t < 10.0; t += 2e-3) {
      double load = 0.0, torque = 0.0;
      for (const double frequency : pair) {
        const double rate = 2.0 * std::numbers::pi * frequency;
        const double one = 0.05 / frequency * std::sin(rate * t + frequency);
        load += one;
        torque -= kInertia * rate * rate * one;
      }
      r.time.push_back(t);
      r.channels[Quantity::load_angle].push_back(load);
      r.channels[Quantity::motor_angle].push_back(100.0 * (load + torque / kStiffness));
      r.channels[Quantity::transmitted_torque].push_back(torque + 0.01 * std::sin(311.0 * t));
    }
  }
  return set;
}

bool doubts_the_ratio(const RecordingSet& set) {
  return std::ranges::any_of(data::sanity_of(set), [](const data::SanityFinding& one) {
    return one.check == "gear_ratio";
  });
}

TEST(SanityOfARatio, IsNotReadOffAWindup) {
  EXPECT_FALSE(doubts_the_ratio(driven_at({{4.0, 6.0}, {5.0, 7.0}, {4.5, 5.5}}, 100.0)));
  EXPECT_FALSE(doubts_the_ratio(driven_at({{0.5, 0.8}, {0.4, 0.6}, {5.5, 5.5}}, 100.0)))
      << "where one sine has its torque go with its angle, the other recordings tell";
}

TEST(SanityOfARatio, IsStillReadThere) {
  EXPECT_TRUE(doubts_the_ratio(driven_at({{4.0, 6.0}, {5.0, 7.0}, {4.5, 5.5}}, 50.0)));
  EXPECT_TRUE(doubts_the_ratio(driven_at({{0.5, 0.8}, {0.4, 0.6}, {5.5, 5.5}}, 160.0)));
}

}  // namespace
}  // namespace flexspline::studies
