// A servo's recordings, simulated with known constants: the constants come back.
#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "servo_pendulum.hpp"

namespace flexspline::estimators {
namespace {

using ::testing::HasSubstr;

double value_of(const Estimate& estimate, const std::string& name) {
  for (const auto& one : estimate.parameters) {
    if (one.name == name) return one.value;
  }
  ADD_FAILURE() << "no " << name;
  return 0.0;
}

TEST(ServoFit, BringsTheConstantsBack) {
  const RecordingSet set = pendulum();
  const auto fit = fit_servo(set, {friction(0.01, 0.002, 0.05), {}, {}}, {.tolerance = 1e-7});
  ASSERT_TRUE(fit) << fit.error().message();
  EXPECT_EQ(fit->estimate.fits.size(), 2U);
  EXPECT_NEAR(value_of(fit->estimate, "torque_constant"), 0.4, 4e-3);
  EXPECT_NEAR(value_of(fit->estimate, "resistance"), 4.0, 0.04);
  EXPECT_NEAR(value_of(fit->estimate, "motor_inertia"), 0.002, 4e-5);
  EXPECT_NEAR(value_of(fit->estimate, "coulomb_viscous_friction.coulomb"), 0.03, 1e-3);
  EXPECT_NEAR(value_of(fit->estimate, "directional_load_friction.motor_share"), 0.1, 5e-3);
  const auto angle = simulate_servo(fit->drive, set.recordings.back());
  ASSERT_TRUE(angle) << angle.error().message();
  const auto& measured = set.recordings.back().channels.at(Quantity::load_angle);
  double worst = 0.0;
  for (std::size_t i = 0; i < measured.size(); ++i)
    worst = std::max(worst, std::abs((*angle)[i] - measured[i]));
  EXPECT_LT(worst, 5e-3);
}

/// What a servo would record whose own loop follows a command with that gain.
Recording looped(const std::string& id, double amplitude, double omega, double gain) {
  Recording one = recording(id, 0.1, omega);
  std::vector<double> goal;
  for (const double t : one.time) goal.push_back(amplitude * std::sin(omega * t));
  one.channels.erase(Quantity::drive_enabled);
  one.channels[Quantity::commanded_angle] = goal;
  auto& duty = one.channels[Quantity::duty_cycle];
  auto& angle = one.channels[Quantity::load_angle];
  std::ranges::fill(angle, 0.0);
  // The gain is read off duty and error: any pair of this proportion will do before the simulation.
  for (std::size_t i = 0; i < goal.size(); ++i) duty[i] = gain * goal[i];
  angle = *simulate_servo(drive(), one, 1e-9, ServoDuty::loop);
  for (std::size_t i = 0; i < goal.size(); ++i)
    duty[i] = std::clamp(gain * (goal[i] - angle[i]), -1.0, 1.0);
  return one;
}

TEST(ServoFit, BringsTheConstantsBackThroughTheServosOwnLoop) {
  RecordingSet set = pendulum();
  set.recordings = {looped("soft", 0.6, 2.0, 0.9), looped("stiff", 0.8, 4.0, 2.0)};
  for (const ServoLoss loss : {ServoLoss::squared, ServoLoss::absolute}) {
    const auto fit = fit_servo(set, {friction(0.01, 0.002, 0.05), {}, {}},
                               {.tolerance = 1e-7, .duty = ServoDuty::loop, .loss = loss});
    ASSERT_TRUE(fit) << fit.error().message();
    EXPECT_NEAR(value_of(fit->estimate, "torque_constant"), 0.4, 4e-3);
    EXPECT_NEAR(value_of(fit->estimate, "resistance"), 4.0, 0.04);
    EXPECT_NEAR(value_of(fit->estimate, "coulomb_viscous_friction.coulomb"), 0.03, 1e-3);
  }
}

// Torque constant, resistance and friction that differ: what the loop corrects stays small.
TEST(ServoFit, LoopCorrectsWhatAModelMisses) {
  const Recording one = looped("stiff", 0.8, 4.0, 2.0);
  DriveSpec wrong = drive();
  wrong.resistance *= 1.2;
  const auto miss = [&](ServoDuty duty) {
    const auto angle = simulate_servo(wrong, one, 1e-8, duty);
    double sum = 0.0;
    for (std::size_t i = 0; i < angle->size(); ++i)
      sum += std::abs((*angle)[i] - one.channels.at(Quantity::load_angle)[i]);
    return sum;
  };
  EXPECT_LT(miss(ServoDuty::loop), 0.5 * miss(ServoDuty::recorded));
}

TEST(ServoFit, FindsTheAngleAtWhichTheLoadHangs) {
  RecordingSet set = pendulum();
  for (Recording& one : set.recordings) {
    for (double& angle : one.channels[Quantity::load_angle]) angle += 0.03;
  }
  const auto fit = fit_servo(set, {friction(0.01, 0.002, 0.05), {}, {}},
                             {.tolerance = 1e-7, .zero = ServoZero::fitted});
  ASSERT_TRUE(fit) << fit.error().message();
  EXPECT_NEAR(value_of(fit->estimate, "load_angle_zero"), 0.03, 1e-3);
  EXPECT_NEAR(value_of(fit->estimate, "resistance"), 4.0, 0.04);
  EXPECT_EQ(fit->estimate.model.effects.size(), 2u) << "those given";
  const auto recorded = fit_servo(set, {friction(0.01, 0.002, 0.05), {}, {}}, {.tolerance = 1e-7});
  ASSERT_TRUE(recorded) << recorded.error().message();
  EXPECT_GT(recorded->estimate.cost, 100.0 * fit->estimate.cost);
}

TEST(ServoFit, SaysHowManyStartsComeHome) {
  RecordingSet set = pendulum();
  set.recordings.resize(1);
  const GivenModel model = {friction(0.02, 0.005, 0.08), {"directional_load_friction"}, {}};
  const auto fit = fit_servo(set, model, {.starts = 3, .seed = 4});
  ASSERT_TRUE(fit) << fit.error().message();
  EXPECT_THAT(fit->estimate.notes, testing::Contains(HasSubstr("of 3 starts end at the best")));
}

TEST(ServoFit, RefusesALoopThatDidNotRun) {
  auto set = pendulum();
  for (Recording& one : set.recordings)
    one.channels[Quantity::commanded_angle].assign(one.time.size(), 0.2);
  const auto fit = fit_servo(set, {friction(0.01, 0.0, 0.0), {}, {}}, {.duty = ServoDuty::loop});
  ASSERT_FALSE(fit);
  EXPECT_THAT(fit.error().message(), HasSubstr("not in proportion"));
}

TEST(ServoFit, RefusesWhatItCannotScaleOrDrive) {
  auto set = pendulum();
  set.constants.erase("load_mass_kg");
  EXPECT_THAT(fit_servo(set, {friction(0.01, 0.0, 0.0), {}, {}}).error().message(),
              HasSubstr("load_mass_kg"));
  set = pendulum();
  set.recordings[0].channels.erase(Quantity::supply_voltage);
  set.recordings[0].channels.erase(Quantity::duty_cycle);
  const auto fit = fit_servo(set, {friction(0.01, 0.0, 0.0), {}, {}});
  ASSERT_FALSE(fit);
  EXPECT_THAT(fit.error().message(), HasSubstr("slow"));
  for (Recording& one : set.recordings) one.split = Split::holdout;
  EXPECT_THAT(fit_servo(set, {friction(0.01, 0.0, 0.0), {}, {}}).error().message(),
              HasSubstr("no recording to train on"));
}

}  // namespace
}  // namespace flexspline::estimators
