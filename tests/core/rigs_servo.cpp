// A servo swings as a pendulum and starts as a DC motor.
#include <numbers>

#include "rig_examples.hpp"

namespace flexspline {
namespace {

DriveSpec bare() {
  DriveSpec drive;
  drive.torsion.f = law_spec("odd_polynomial", 1.0, {}, {1.0});
  drive.torsion.g_inverse = drive.torsion.f;
  drive.torsion.h = law_spec("bounded_modulation", 1.0, {}, {});
  drive.gear_ratio = 20.0;
  drive.motor_inertia = 1e-4;
  drive.load_inertia = 0.02;
  drive.torque_constant = 0.05;
  drive.resistance = 1.5;
  drive.back_emf = 0.05;
  return drive;
}

TEST(Servo, SwingsWithThePeriodOfItsPendulum) {
  DriveSpec drive = bare();
  drive.load_mass = 0.49;
  drive.arm_length = 0.1;
  const auto rig = made_rig(Rig::servo, drive, {{{Quantity::motor_torque, constant(0.0)}}, {}});
  const double inertia = reflected_inertia(drive) + drive.load_inertia;
  const double w = std::sqrt(0.49 * 0.1 * drive.gravity / inertia);
  constexpr double kAngle = 1e-3;
  const auto times = instants(4.0 * std::numbers::pi / w, 40);
  const auto y = simulated(*rig, rig->parameter_vector(), times, std::vector<double>{kAngle, 0.0},
                           1e-10, 1e-13);
  // The period grows by angle^2/16.
  const double slowed = w * (1.0 - kAngle * kAngle / 16.0);
  for (std::size_t i = 0; i < times.size(); ++i) {
    EXPECT_NEAR(y[2 * i], kAngle * std::cos(slowed * times[i]), 1e-7 * kAngle) << times[i];
  }
}

struct Step {
  DriveSpec drive;
  RigInputs inputs;
};

Step voltage_step() {
  return {bare(),
          {{{Quantity::duty_cycle, constant(0.5)}, {Quantity::supply_voltage, constant(7.4)}}, {}}};
}

TEST(Servo, StartsAsAMotorAtAVoltage) {
  const auto [drive, inputs] = voltage_step();
  const auto rig = made_rig(Rig::servo, drive, inputs, "voltage_driven");
  const auto times = instants(1.0, 20);
  const auto y = simulated(*rig, rig->parameter_vector(), times, rig->rest(), 1e-11, 1e-13);
  const double inertia = drive.motor_inertia + drive.load_inertia / 400.0;
  const double rate = drive.torque_constant * drive.back_emf / (drive.resistance * inertia);
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double speed = 0.5 * 7.4 / drive.back_emf * (1.0 - std::exp(-rate * times[i]));
    EXPECT_NEAR(y[2 * i + 1] * 20.0 / speed, 1.0, 1e-8) << times[i];
  }
}

// Both poles of motor and winding in closed form.
TEST(Servo, StartsSlowerThroughItsWinding) {
  auto [drive, inputs] = voltage_step();
  drive.inductance = 0.02;
  const auto rig = made_rig(Rig::servo, drive, inputs, "winding");
  ASSERT_EQ(rig->states(), 3u);
  const auto times = instants(0.5, 20);
  const auto y = simulated(*rig, rig->parameter_vector(), times, rig->rest(), 1e-11, 1e-13);
  const double inertia = drive.motor_inertia + drive.load_inertia / 400.0;
  const double half = 0.5 * drive.resistance / drive.inductance;
  const double stiff = drive.torque_constant * drive.back_emf / (drive.inductance * inertia);
  ASSERT_GT(half * half, stiff);
  const double root = std::sqrt(half * half - stiff);
  const double slow = -half + root;
  const double fast = -half - root;
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double t = times[i];
    const double shape =
        1.0 + (fast * std::exp(slow * t) - slow * std::exp(fast * t)) / (slow - fast);
    EXPECT_NEAR(y[3 * i + 1] * 20.0 / (0.5 * 7.4 / drive.back_emf), shape, 1e-8) << t;
  }
}

TEST(Servo, HasNoTorqueWhileItIsOff) {
  auto [drive, inputs] = voltage_step();
  inputs.channels[Quantity::drive_enabled] = constant(0.0);
  const auto rig = made_rig(Rig::servo, drive, inputs, "voltage_driven");
  const auto x = rig->instant(0.0, std::vector<double>{0.1, 2.0}, rig->parameter_vector());
  EXPECT_EQ(x.motor_torque, 0.0);
  EXPECT_EQ(x.load_acceleration, 0.0);
}

// Friction mu |tau| in the gear, tau = J2 a + m g l sin(theta): the acceleration is implicit.
TEST(Servo, SolvesForTheTorqueThatItsFrictionDependsOn) {
  DriveSpec drive = bare();
  drive.load_mass = 2.0;
  drive.arm_length = 0.3;
  const auto row = find_effect("load_dependent_friction");
  ASSERT_TRUE(row);
  EffectSpec friction{"load_dependent_friction", {}};
  for (const auto& one : (*row)->parameters) {
    friction.parameters.emplace_back(std::string(one.name), one.nominal);
  }
  drive.torsion.effects = {friction};
  const auto rig = made_rig(Rig::servo, drive, {{{Quantity::motor_torque, constant(0.4)}}, {}});
  const auto p = rig->parameter_vector();
  const auto x = rig->instant(0.0, std::vector<double>{0.8, 3.0}, p);
  std::vector<double> values;
  for (const auto& one : friction.parameters) values.push_back(one.second);
  const double lost = (*row)->real.term(x, values, {});
  EXPECT_GT(std::abs(lost), 1e-3);
  const double tau = 0.02 * x.load_acceleration + 2.0 * 0.3 * drive.gravity * std::sin(0.8);
  EXPECT_NEAR(x.transmitted_torque, tau, 1e-12);
  EXPECT_NEAR(20.0 * (0.4 - drive.motor_inertia * x.motor_acceleration - lost), tau, 1e-10);
}

TEST(ServoRig, RefusesKinematicsForWhichItHasNoTorsion) {
  DriveSpec drive = example_drive();
  drive.torsion.effects = {{"backlash", {{"half_gap", 1e-4}, {"rounding", 2e-5}}}};
  const auto rig =
      make_rig(Rig::servo, drive, {{{Quantity::motor_torque, constant(0.1)}}, {}}, "torque_driven");
  ASSERT_FALSE(rig);
  EXPECT_THAT(rig.error().message(), testing::HasSubstr("rigid"));
}

}  // namespace
}  // namespace flexspline
