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
      EXPECT_NEAR(torque[i] / 5.0, expected, 1e-13) << "step " << step << " at " << x;
    }
  }
}

/// Slip lengths from z = 0, in closed form: int_0^z du / (1 - sgn(u) |u|^n).
double slip_lengths(double z, double exponent) {
  const double a = std::abs(z);
  if (exponent == 1.0) return z < 0.0 ? -std::log1p(a) : -std::log1p(-a);
  if (exponent == 2.0) return z < 0.0 ? -std::atan(a) : std::atanh(a);
  const double root = std::sqrt(a);  // exponent 1/2
  return z < 0.0 ? 2.0 * (std::log1p(root) - root) : -2.0 * (root + std::log1p(-root));
}

TEST(BoucWen, GoesAsFarAsItsClosedFormsWhateverTheSampling) {
  constexpr double kSlip = 0.4;
  for (const double exponent : {0.5, 1.0, 2.0}) {
    for (const double step : {0.5, 1.0 / 8.0, 1.0 / 512.0}) {
      const auto motion = zigzag({0.0, 1.0, -0.5}, step);
      const auto torque = torque_of(
          "bouc_wen", {{"height", 5.0}, {"slip_length", kSlip}, {"exponent", exponent}}, motion);
      const auto turn = static_cast<std::size_t>(1.0 / step);
      const double top = slip_lengths(-torque[turn] / 5.0, exponent);
      for (std::size_t i = 0; i < torque.size(); ++i) {
        const double x = motion.position[i];
        const double z = torque[i] / 5.0;
        const double gone =
            i <= turn ? slip_lengths(z, exponent) : slip_lengths(-z, exponent) - top;
        EXPECT_NEAR(gone, (i <= turn ? x : 1.0 - x) / kSlip, 1e-11)
            << "exponent " << exponent << ", step " << step << " at " << x;
      }
    }
  }
}

// Whatever the exponent, one step goes where many go.
TEST(BoucWen, DoesNotSeeItsSampling) {
  for (const double exponent : {0.2, 0.7, 1.3, 3.0, 5.0}) {
    const Parameters law = {{"height", 5.0}, {"slip_length", 0.3}, {"exponent", exponent}};
    const auto coarse = torque_of("bouc_wen", law, zigzag({0.0, 1.0, -0.5, 0.25}, 0.25));
    const auto fine = torque_of("bouc_wen", law, zigzag({0.0, 1.0, -0.5, 0.25}, 1.0 / 1024.0));
    for (std::size_t i = 0; i < coarse.size(); ++i) {
      EXPECT_NEAR(coarse[i], fine[256 * i], 1e-12) << "exponent " << exponent << " at " << i;
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

TEST(TorqueSensorLag, IsTheFirstOrderLowPassOfASine) {
  const double omega = 9.0;
  const double lag = 0.08;
  const auto motion = harmonic_motion({1.0}, 4000, 4);
  std::vector<double> torque;
  for (double t : motion.time) torque.push_back(std::sin(omega * t));
  const auto row = find_effect("torque_sensor_lag");
  ASSERT_TRUE(row);
  ASSERT_TRUE(apply_along(**row, {"torque_sensor_lag", {{"time_constant", lag}}},
                          instants_of(motion), torque));
  EXPECT_EQ(torque.front(), 0.0);
  const double share = 1.0 / (1.0 + std::pow(omega * lag, 2));
  for (std::size_t i = 0; i < torque.size(); ++i) {
    const double t = motion.time[i];
    const double settled = share * (std::sin(omega * t) - omega * lag * std::cos(omega * t));
    EXPECT_NEAR(torque[i], settled + share * omega * lag * std::exp(-t / lag), 1e-5);
  }
}

// An inertia behind a dashpot, T w' = phi' - w, along phi = cos(omega t), at rest at first.
TEST(CarriedInertia, FollowsASineBehindItsDashpot) {
  const double inertia = 1.6;
  const double lag = 0.08;
  const double omega = 2.0 * std::numbers::pi;
  const auto motion = harmonic_motion({1.0}, 4000, 4);
  const auto row = find_effect("carried_inertia");
  ASSERT_TRUE(row);
  std::vector<double> torque(motion.time.size(), 0.0);
  ASSERT_TRUE(apply_along(**row,
                          {"carried_inertia", {{"inertia", inertia}, {"time_constant", lag}}},
                          instants_of(motion), torque));
  const double most = inertia * omega * omega / (1.0 + std::pow(omega * lag, 2));
  for (std::size_t i = 0; i < torque.size(); ++i) {
    const double t = motion.time[i];
    const double wave = std::cos(omega * t) + omega * lag * std::sin(omega * t);
    EXPECT_NEAR(torque[i], -most * (wave - std::exp(-t / lag)), 1e-5 * most);
  }
}

TEST(TorqueSensorLag, FollowsARampAtItsTimeConstantOverAnySteps) {
  const std::vector<double> time = {0.0, 0.01, 0.5, 0.52, 3.0};
  std::vector<double> shown;
  for (double t : time) shown.push_back(2.0 * t);
  const auto row = find_effect("torque_sensor_lag");
  ASSERT_TRUE(row);
  std::vector<double> none = shown;
  const double lag = 0.05;
  (*row)->map(time, shown, std::vector{lag});
  for (std::size_t i = 0; i < time.size(); ++i) {
    EXPECT_NEAR(shown[i], 2.0 * (time[i] - lag * (1.0 - std::exp(-time[i] / lag))), 1e-14);
  }
  const auto before = none;
  (*row)->map(time, none, std::vector{0.0});
  EXPECT_EQ(none, before);
}

TEST(TorqueSensorOffset, AddsAConstant) {
  const auto motion = harmonic_motion({1.0}, 50);
  for (double value : torque_of("torque_sensor_offset", {{"offset", 0.75}}, motion)) {
    EXPECT_EQ(value, 0.75);
  }
}

}  // namespace
}  // namespace flexspline
