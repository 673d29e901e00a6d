// The laws of single effects against their closed forms.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "effect_paths.hpp"
#include "flexspline/core/effect_path.hpp"
#include "motions.hpp"

namespace flexspline {
namespace {

std::vector<double> torque_of(const std::string& effect, const Parameters& parameters,
                              const Motion& motion) {
  const auto row = find_effect(effect);
  EXPECT_TRUE(row);
  const auto torque = terms_along(**row, {effect, parameters}, instants_of(motion));
  EXPECT_TRUE(torque);
  return *torque;
}

class MemoryEffect : public testing::TestWithParam<std::pair<std::string, Parameters>> {};

TEST_P(MemoryEffect, DoesNotKnowTheClock) {
  const auto& [effect, parameters] = GetParam();
  auto motion = harmonic_motion({2e-3, 1e-3}, 500, 2);
  const auto torque = torque_of(effect, parameters, motion);
  for (auto& t : motion.time) t = 37.0 * t + 0.3 * t * t;
  for (auto& v : motion.velocity) v /= 37.0;
  for (auto& a : motion.acceleration) a /= 37.0 * 37.0;
  EXPECT_THAT(torque_of(effect, parameters, motion),
              testing::Pointwise(testing::DoubleNear(1e-12), torque));
}

INSTANTIATE_TEST_SUITE_P(
    RateIndependent, MemoryEffect,
    testing::Values(
        std::pair<std::string, Parameters>{
            "presliding_hysteresis",
            {{"stiffness", 900.0}, {"yield", 3e-4}, {"stiffness", 400.0}, {"yield", 1.1e-3}}},
        std::pair<std::string, Parameters>{
            "bouc_wen", {{"height", 4.5}, {"slip_length", 3e-4}, {"exponent", 1.7}}}),
    [](const auto& param) { return param.param.first; });

constexpr double kStep = 1.0 / 64.0;  // exact in binary: the stops yield on samples

TEST(PreslidingHysteresis, LosesFourTimesTheYieldForceTimesTheSlip) {
  for (double yield : {0.125, 0.25, 0.75}) {
    for (double amplitude : {1.0, 2.0}) {
      const double a = amplitude;
      const auto motion = zigzag({0.0, a, -a, a, -a, a}, kStep);
      const auto torque =
          torque_of("presliding_hysteresis", {{"stiffness", 3.0}, {"yield", yield}}, motion);
      const auto cycle = static_cast<std::size_t>(4.0 * a / kStep);
      const std::size_t last = motion.position.size() - 1;
      EXPECT_NEAR(work(motion, torque, last - cycle, last), 4.0 * 3.0 * yield * (a - yield), 1e-12);
    }
  }
}

TEST(PreslidingHysteresis, IsElasticBelowItsYield) {
  const auto motion = zigzag({0.0, 0.25, -0.25, 0.25}, kStep);
  const auto torque =
      torque_of("presliding_hysteresis", {{"stiffness", 3.0}, {"yield", 0.5}}, motion);
  for (std::size_t i = 0; i < torque.size(); ++i) {
    EXPECT_NEAR(torque[i], 3.0 * motion.position[i], 1e-12);
  }
}

// A minor loop leaves no trace: after it the torque goes on as if it had not been.
TEST(PreslidingHysteresis, ClosesMinorLoopsAndForgetsThem) {
  const Parameters stops = {{"stiffness", 3.0}, {"yield", 0.125},   {"stiffness", 2.0},
                            {"yield", 0.3},     {"stiffness", 1.0}, {"yield", 0.7}};
  const auto straight = zigzag({0.0, 2.0, -2.0, 0.5, 2.0}, kStep);
  const auto detour = zigzag({0.0, 2.0, -2.0, 0.5, -0.25, 0.25, 0.0, 0.5, 2.0}, kStep);
  const auto without = torque_of("presliding_hysteresis", stops, straight);
  const auto with = torque_of("presliding_hysteresis", stops, detour);
  const std::size_t after = static_cast<std::size_t>(1.5 / kStep);
  for (std::size_t i = 0; i <= after; ++i) {
    EXPECT_NEAR(with[with.size() - 1 - i], without[without.size() - 1 - i], 1e-12);
  }
}

TEST(BoucWen, FollowsDahlsExponentialWhateverTheSampling) {
  constexpr double kSlip = 0.3;
  for (double step : {1.0 / 8.0, 1.0 / 64.0, 1.0 / 512.0}) {
    const auto motion = zigzag({0.0, 1.0, -1.0}, step);
    const auto torque =
        torque_of("bouc_wen", {{"height", 5.0}, {"slip_length", kSlip}, {"exponent", 1.0}}, motion);
    const auto turn = static_cast<std::size_t>(1.0 / step);
    const double top = 1.0 - std::exp(-1.0 / kSlip);
    for (std::size_t i = 0; i < torque.size(); ++i) {
      const double x = motion.position[i];
      const double expected =
          i <= turn ? 1.0 - std::exp(-x / kSlip) : -1.0 + (1.0 + top) * std::exp((x - 1.0) / kSlip);
      EXPECT_NEAR(torque[i] / 5.0, expected, 1e-3) << "step " << step << " at " << x;
    }
  }
}

TEST(BoucWen, NeverExceedsItsHeight) {
  for (double exponent : {0.2, 1.0, 5.0}) {
    const auto motion = harmonic_motion({1.0, 0.7, 0.3}, 37, 3);
    for (double value :
         torque_of("bouc_wen", {{"height", 5.0}, {"slip_length", 0.01}, {"exponent", exponent}},
                   motion)) {
      EXPECT_LE(std::abs(value), 5.0);
    }
  }
}

TEST(InertiaTorque, IsNewtonsAndGivesBackItsWork) {
  constexpr int kPerCycle = 256;
  const auto motion = harmonic_motion({2.0, 1.0, 0.5}, kPerCycle);
  const auto torque = torque_of("inertia_torque", {{"inertia", 1.8}}, motion);
  double net = 0.0;
  double moved = 0.0;
  for (int i = 0; i < kPerCycle; ++i) {
    const auto k = static_cast<std::size_t>(i);
    EXPECT_NEAR(torque[k], 1.8 * motion.acceleration[k], 1e-12);
    net += torque[k] * motion.velocity[k] / kPerCycle;
    moved += std::abs(torque[k] * motion.velocity[k]) / kPerCycle;
  }
  EXPECT_NEAR(net / moved, 0.0, 1e-12);
}

TEST(SensorDelay, ShiftsTheTorqueInTime) {
  const auto motion = harmonic_motion({1.0}, 2000, 2);
  std::vector<double> torque;
  for (double t : motion.time) torque.push_back(std::sin(9.0 * t));
  const auto row = find_effect("sensor_delay");
  ASSERT_TRUE(row);
  ASSERT_TRUE(
      apply_along(**row, {"sensor_delay", {{"delay", 0.0123}}}, instants_of(motion), torque));
  for (std::size_t i = 100; i < torque.size(); ++i) {
    EXPECT_NEAR(torque[i], std::sin(9.0 * (motion.time[i] - 0.0123)), 1e-7);
  }
}

TEST(TorqueSensorOffset, AddsAConstant) {
  const auto motion = harmonic_motion({1.0}, 50);
  for (double value : torque_of("torque_sensor_offset", {{"offset", 0.75}}, motion)) {
    EXPECT_EQ(value, 0.75);
  }
}

}  // namespace
}  // namespace flexspline
