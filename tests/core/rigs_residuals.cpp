// Each equation on its own: a cause in one leaves the others alone.
#include "rig_examples.hpp"

namespace flexspline {
namespace {

struct Bench {
  DriveSpec drive = example_drive();
  std::vector<double> times = instants(1.0, 400);
  DriveChannels channels;
  std::vector<Instant<double>> path;
};

// The free rig with exact derivatives; `actual` is what turns, with causes that `drive` lacks.
Bench free_bench(const DriveSpec& actual) {
  Bench bench;
  const auto rig = made_rig(Rig::free, actual, {{{Quantity::motor_torque, sine(0.5, 2.0)}}, {}});
  const auto p = rig->parameter_vector();
  const auto y = simulated(*rig, p, bench.times, rig->rest(), 1e-9, 1e-12);
  bench.path = instants_along(*rig, p, bench.times, y);
  DriveChannels& c = bench.channels;
  c.time = bench.times;
  for (const auto& x : bench.path) {
    c.motor_angle.push_back(x.motor_angle);
    c.motor_speed.push_back(x.motor_speed);
    c.motor_acceleration.push_back(x.motor_acceleration);
    c.load_angle.push_back(x.load_angle);
    c.load_speed.push_back(x.load_speed);
    c.load_acceleration.push_back(x.load_acceleration);
    c.transmitted_torque.push_back(x.transmitted_torque);
    c.motor_torque.push_back(x.motor_torque);
  }
  return bench;
}

double largest(const std::vector<double>& values) {
  double size = values.empty() ? std::nan("") : 0.0;
  for (double v : values) size = std::max(size, std::abs(v));
  return size;
}

constexpr double kNothing = 1e-9;

TEST(Residuals, AreZeroOnWhatWasSimulated) {
  const Bench bench = free_bench(example_drive());
  const auto r = residuals(Rig::free, bench.drive, bench.channels);
  ASSERT_TRUE(r) << r.error().message();
  EXPECT_LT(largest(r->motor.value), kNothing);
  EXPECT_LT(largest(r->load.value), kNothing);
  EXPECT_LT(largest(r->torsion.value), kNothing);
  EXPECT_LT(largest(r->drive.value), 50.0 * kNothing);
}

// What the kinematics return to the shafts is in both equations.
TEST(Residuals, AreZeroOnWhatWasSimulatedWithKinematics) {
  DriveSpec drive = example_drive();
  drive.torsion.effects = {
      {"kinematic_error", {{"amplitude", 1.5e-4}, {"order", 2.0}, {"phase", 0.4}}},
      {"output_kinematic_error", {{"amplitude", 1e-4}, {"order", 1.0}, {"phase", 0.2}}},
      {"series_compliance", {{"compliance", 4.8e-5}}},
      {"load_dependent_kinematic_error", {{"compliance", 2e-5}, {"order", 2.0}, {"phase", 0.1}}},
      {"stiffness_ripple", {{"stiffness", 600.0}, {"order", 2.0}, {"phase", 0.7}}}};
  const Bench bench = free_bench(drive);
  const auto r = residuals(Rig::free, drive, bench.channels);
  ASSERT_TRUE(r) << r.error().message();
  EXPECT_LT(largest(r->motor.value), 1e-4 * largest(bench.channels.motor_torque));
  EXPECT_LT(largest(r->load.value), kNothing);
  drive.torsion.effects.clear();
  const auto without = residuals(Rig::free, drive, bench.channels);
  ASSERT_TRUE(without);
  EXPECT_GT(largest(without->motor.value), 1e-2 * largest(bench.channels.motor_torque));
}

TEST(Residuals, ShowACauseInItsOwnEquation) {
  DriveSpec motor = example_drive();
  motor.motor_viscous *= 1.5;
  DriveSpec load = example_drive();
  load.load_viscous *= 1.5;
  DriveSpec gear = example_drive();
  gear.torsion.effects = {{"viscoelastic_creep", {{"stiffness", 4500.0}, {"time_constant", 0.3}}}};
  const DriveSpec causes[] = {motor, load, gear};
  for (std::size_t cause = 0; cause < 3; ++cause) {
    const Bench bench = free_bench(causes[cause]);
    const auto r = residuals(Rig::free, bench.drive, bench.channels);
    ASSERT_TRUE(r);
    const double sizes[] = {largest(r->motor.value), largest(r->load.value),
                            largest(r->torsion.value)};
    for (std::size_t k = 0; k < 3; ++k) {
      if (k == cause) {
        EXPECT_GT(sizes[k], 1e-3) << cause;
      } else {
        EXPECT_LT(sizes[k], kNothing) << cause << " in " << k;
      }
    }
  }
}

TEST(Residuals, AreContaminatedByATorqueSensorsGainInTheRatioOfTheGear) {
  Bench bench = free_bench(example_drive());
  const std::vector<double> truth = bench.channels.transmitted_torque;
  for (double& tau : bench.channels.transmitted_torque) tau *= 1.02;
  const auto r = residuals(Rig::free, bench.drive, bench.channels);
  ASSERT_TRUE(r);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_NEAR(r->motor.value[i], -0.02 * truth[i] / 50.0, kNothing);
    EXPECT_NEAR(r->load.value[i], 0.02 * truth[i], kNothing);
    EXPECT_NEAR(r->torsion.value[i], 0.02 * truth[i], kNothing);
    EXPECT_NEAR(r->drive.value[i], 0.0, 50.0 * kNothing);
  }
}

TEST(Residuals, SayWhatIsMissing) {
  Bench bench = free_bench(example_drive());
  bench.channels.transmitted_torque.clear();
  const auto r = residuals(Rig::free, bench.drive, bench.channels);
  ASSERT_TRUE(r);
  for (const EquationResidual* one : {&r->motor, &r->load, &r->torsion}) {
    EXPECT_TRUE(one->value.empty());
    EXPECT_EQ(one->absent, "transmitted_torque is not measured");
  }
  EXPECT_LT(largest(r->drive.value), 50.0 * kNothing);
  const auto servo = residuals(Rig::servo, bench.drive, bench.channels);
  ASSERT_TRUE(servo);
  EXPECT_THAT(servo->torsion.absent, testing::HasSubstr("servo rig has no such equation"));
  bench.channels.motor_torque.pop_back();
  const auto refused = residuals(Rig::free, bench.drive, bench.channels);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message(), testing::HasSubstr("motor_torque has 400 samples"));
}

// From a recording, with derivatives by smoothing: small beside the torque.
TEST(Residuals, ComeFromARecording) {
  const DriveSpec drive = example_drive();
  const auto rig = made_rig(Rig::free, drive, {{{Quantity::motor_torque, sine(0.5, 2.0)}}, {}});
  const auto p = rig->parameter_vector();
  const auto times = instants(2.0, 4000);
  const auto y = simulated(*rig, p, times, rig->rest(), 1e-10, 1e-13);
  const auto recording = record_of(rig_row(Rig::free), *rig, p, times, y);
  ASSERT_TRUE(recording);
  const auto channels = drive_channels(Rig::free, drive, *recording);
  ASSERT_TRUE(channels);
  const auto r = residuals(Rig::free, drive, *channels);
  ASSERT_TRUE(r);
  const std::vector<double> inner(r->load.value.begin() + 800, r->load.value.end() - 800);
  EXPECT_LT(largest(inner), 0.02 * largest(channels->transmitted_torque));
}

}  // namespace
}  // namespace flexspline
