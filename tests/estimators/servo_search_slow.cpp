// Where a servo's fit starts: as told, or where searches without derivatives end.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "servo_pendulum.hpp"

namespace flexspline::estimators {
namespace {

using ::testing::HasSubstr;

const ServoSettings kOneStep = {.most_iterations = 1, .tolerance = 1e-7};

TEST(ServoStart, IsWhereItIsTold) {
  const RecordingSet set = pendulum();
  const GivenModel model = {friction(0.03, 0.01, 0.1), {}, {}};
  const auto usual = fit_servo(set, model, kOneStep);
  ServoSettings settings = kOneStep;
  settings.start = {{"torque_constant", 0.4}, {"resistance", 4.0}, {"motor_inertia", 0.002}};
  const auto told = fit_servo(set, model, settings);
  ASSERT_TRUE(usual && told);
  EXPECT_LT(told->estimate.cost, 1e-3 * usual->estimate.cost) << "the truth";
}

TEST(ServoStart, IsRefusedByName) {
  const RecordingSet set = pendulum();
  const GivenModel model = {friction(0.03, 0.01, 0.1), {}, {}};
  ServoSettings settings = kOneStep;
  settings.start = {{"torque_constnt", 0.4}};
  EXPECT_THAT(fit_servo(set, model, settings).error().message(),
              HasSubstr("did you mean 'torque_constant'?"));
  settings.start = {{"resistance", -4.0}};
  EXPECT_THAT(fit_servo(set, model, settings).error().message(), HasSubstr("starts at -4 Ohm"));
  settings.start = {{"load_angle_zero", 0.01}};
  EXPECT_FALSE(fit_servo(set, model, settings)) << "known here";
  settings.zero = ServoZero::fitted;
  EXPECT_TRUE(fit_servo(set, model, settings));
}

/// Friction of which the load gets loose at some speed.
ModelSpec sticking(double share, double speed) {
  ModelSpec model = friction(0.01, 0.005, 0.1);
  model.effects[0].parameters[2].second = 0.01;
  model.effects[1].parameters = {
      {"motor_share", 0.1}, {"load_share", 0.1}, {"smoothing", 0.01}, {"load_smoothing", 0.002}};
  model.effects.push_back({"stribeck_load_friction",
                           {{"motor_share", share},
                            {"load_share", share},
                            {"stribeck_speed", speed},
                            {"exponent", 1.0},
                            {"smoothing", 0.01},
                            {"load_smoothing", 0.002}}});
  return model;
}

/// Raised slowly in its own loop: it sticks on the way and may jump.
Recording raised(double height, double omega, double gain) {
  Recording one;
  one.id = "raised";
  for (int k = 0; k < 400; ++k) {
    const double t = 0.01 * k;
    one.time.push_back(t);
    one.channels[Quantity::commanded_angle].push_back(height * std::sin(omega * t));
  }
  auto& goal = one.channels[Quantity::commanded_angle];
  one.channels[Quantity::supply_voltage].assign(one.time.size(), 7.4);
  one.channels[Quantity::load_angle].assign(one.time.size(), 0.0);
  auto& duty = one.channels[Quantity::duty_cycle];
  for (const double g : goal) duty.push_back(gain * g);
  DriveSpec d = drive();
  d.torsion = sticking(0.25, 0.3);
  const auto angle = *simulate_servo(d, one, 1e-8, ServoDuty::loop);
  for (std::size_t i = 0; i < goal.size(); ++i) duty[i] = gain * (goal[i] - angle[i]);
  one.channels[Quantity::load_angle] = angle;
  return one;
}

TEST(ServoSearch, ComesHomeWhereTheLoadSticks) {
  RecordingSet set = pendulum();
  set.recordings = {raised(0.9, 0.8, 0.6), raised(0.9, 5.0, 1.5)};
  const GivenModel model = {
      sticking(0.1, 3.0),
      {"coulomb_viscous_friction", "directional_load_friction", "stribeck_load_friction.exponent"},
      {}};
  ServoSettings settings{.duty = ServoDuty::loop, .loss = ServoLoss::absolute};
  const auto plain = fit_servo(set, model, settings);
  settings.searches = 2;
  const auto searched = fit_servo(set, model, settings);
  ASSERT_TRUE(plain) << plain.error().message();
  ASSERT_TRUE(searched) << searched.error().message();
  EXPECT_GT(plain->estimate.cost, 1.0);
  EXPECT_LT(searched->estimate.cost, 1e-6);
  const auto& found = searched->estimate.parameters;
  EXPECT_NEAR(found[0].value, 0.4, 1e-3) << found[0].name;
  EXPECT_NEAR(found[5].value, 0.3, 1e-3) << found[5].name;
  EXPECT_THAT(searched->estimate.notes, testing::Contains(HasSubstr("of 2 searches")));
  settings.starts = 3;
  EXPECT_THAT(fit_servo(set, model, settings).error().message(), HasSubstr("leave out one"));
}

}  // namespace
}  // namespace flexspline::estimators
