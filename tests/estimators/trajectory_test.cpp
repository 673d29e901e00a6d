// The full-trajectory fit on gears whose laws are known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gears.hpp"

namespace flexspline::estimators {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

double effect(const Estimate& estimate, std::string_view id) {
  for (const auto& one : estimate.model.effects) {
    if (one.effect == id) return one.parameters.front().second;
  }
  return 0.0;
}

TEST(Trajectory, FindsAllThreeFunctionsWithoutNoise) {
  const auto gear = gear_with_even_h();
  for (std::string simulate : {"torsion", "torque"}) {
    const auto estimate = fitted("trajectory_ceres", four_loops(gear, {}),
                                 {.numbers = {}, .words = {{"simulate", simulate}}});
    ASSERT_TRUE(estimate) << estimate.error().message();
    EXPECT_EQ(estimate->termination, Termination::converged);
    EXPECT_EQ(estimate->identifiability.verdict, "identifiable");
    EXPECT_LT(worst_error(estimate->model.f, gear.f, kAmplitude), 5e-4) << simulate;
    EXPECT_LT(worst_error(estimate->model.g_inverse, gear.g_inverse, kSpeed), 5e-4) << simulate;
    // At the ends of the motion the speed vanishes, and with it what shows h.
    EXPECT_LT(rms_error(estimate->model.h, gear.h, 0.9 * kAmplitude), 5e-4) << simulate;
  }
}

TEST(Trajectory, FindsAllThreeFunctionsInNoise) {
  const auto gear = gear_with_even_h();
  const auto estimate =
      fitted("trajectory_ceres", four_loops(gear, {.cycles = 4, .per_cycle = 500, .noise = 0.005}));
  ASSERT_TRUE(estimate);
  EXPECT_LT(worst_error(estimate->model.f, gear.f, kAmplitude), 2e-3);
  EXPECT_LT(worst_error(estimate->model.g_inverse, gear.g_inverse, kSpeed), 4e-3);
  EXPECT_LT(worst_error(estimate->model.h, gear.h, 0.9 * kAmplitude), 2e-2);
}

TEST(Trajectory, LeavesNothingButNoise) {
  const auto estimate =
      fitted("trajectory_ceres", four_loops(gear_with_even_h(), {.per_cycle = 400, .noise = 0.005}),
             {.numbers = {}, .words = {{"simulate", "torque"}}});
  ASSERT_TRUE(estimate);
  for (const auto& fit : estimate->fits) EXPECT_NEAR(fit.rmse, 1.0, 0.08) << fit.id;
}

TEST(Trajectory, DoesNotPrintAnHThatOneLoopCannotShow) {
  const auto estimate =
      fitted("trajectory_ceres", {measured(gear_with_even_h(), {.noise = 0.005})});
  ASSERT_TRUE(estimate);
  EXPECT_EQ(estimate->identifiability.verdict, "not_identifiable");
  EXPECT_THAT(estimate->identifiability.says,
              AllOf(HasSubstr("h cannot be identified from one recording"),
                    HasSubstr("Missing: a loop of half the amplitude")));
  for (const auto& band : estimate->bands) EXPECT_NE(band.function, "h");
  for (const auto& one : estimate->parameters) EXPECT_THAT(one.name, Not(HasSubstr("h[")));
  EXPECT_TRUE(estimate->model.h.coefficients.empty());
}

TEST(Trajectory, KeepsHAtOneWhenAsked) {
  const auto estimate = fitted("trajectory_ceres", four_loops(smooth_gear(), {.noise = 0.003}),
                               {.numbers = {}, .words = {{"h", "unity"}}});
  ASSERT_TRUE(estimate);
  EXPECT_TRUE(estimate->model.h.coefficients.empty());
  EXPECT_THAT(estimate->identifiability.says, HasSubstr("h = 1 was set"));
}

// 5 % of the peak at the largest amplitude and frequency.
TEST(Trajectory, FindsAnInertia) {
  auto gear = smooth_gear();
  gear.inertia = 0.8 / (kAmplitude * std::pow(2.0 * std::numbers::pi * kFrequency, 2));
  const auto estimate = fitted("trajectory_ceres", four_loops(gear, {.noise = 1e-3}));
  ASSERT_TRUE(estimate);
  EXPECT_NEAR(effect(*estimate, "inertia_torque") / gear.inertia, 1.0, 0.03);
  EXPECT_EQ(effect(*estimate, "sensor_delay"), 0.0);
  EXPECT_LT(worst_error(estimate->model.f, gear.f, kAmplitude), 3e-3);
}

// 0.03 rad of the fastest cycle.
TEST(Trajectory, FindsADelay) {
  auto gear = smooth_gear();
  gear.delay = 0.03 / (2.0 * std::numbers::pi * kFrequency);
  const auto estimate = fitted("trajectory_ceres", four_loops(gear, {.noise = 1e-3}));
  ASSERT_TRUE(estimate);
  EXPECT_NEAR(effect(*estimate, "sensor_delay") / gear.delay, 1.0, 0.05);
  EXPECT_EQ(effect(*estimate, "inertia_torque"), 0.0);
  EXPECT_LT(worst_error(estimate->model.g_inverse, gear.g_inverse, kSpeed), 5e-3);
}

TEST(Trajectory, SaysWhatItDoesNotFitBecauseTheRecordsCannotTell) {
  const auto estimate = fitted("trajectory_ceres", {measured(smooth_gear(), {.noise = 0.005})});
  ASSERT_TRUE(estimate);
  EXPECT_THAT(estimate->notes, Contains(HasSubstr("inertia is not fitted")));
  EXPECT_TRUE(estimate->model.effects.empty());
}

}  // namespace
}  // namespace flexspline::estimators
