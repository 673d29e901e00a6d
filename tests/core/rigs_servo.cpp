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

// The loop asks for kp times the error, and for no more than the bridge can give.
TEST(Servo, FollowsItsOwnPositionLoop) {
  auto [drive, inputs] = voltage_step();
  inputs.channels[Quantity::commanded_angle] = constant(0.3);
  inputs.position_gain = constant(2.0);
  const auto loop = made_rig(Rig::servo, drive, inputs, "position_loop");
  const auto p = loop->parameter_vector();
  for (const auto& [angle, duty] : {std::pair{0.05, 0.5}, {-0.4, 1.0}, {0.9, -1.0}}) {
    inputs.channels[Quantity::duty_cycle] = constant(duty);
    const auto fed = made_rig(Rig::servo, drive, inputs, "voltage_driven");
    const std::vector<double> y{angle, 1.5};
    EXPECT_DOUBLE_EQ(loop->instant(0.0, y, p).motor_torque, fed->instant(0.0, y, p).motor_torque);
  }
  inputs.position_gain.reset();
  const auto refused = make_rig(Rig::servo, drive, inputs, "position_loop");
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message(), testing::HasSubstr("position loop is given no gain"));
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

TEST(ServoRig, RefusesKinematicsWhereItHasNoTorsion) {
  DriveSpec drive = example_drive();
  drive.torsion.effects = {{"backlash", {{"half_gap", 1e-4}, {"rounding", 2e-5}}}};
  const auto rig =
      make_rig(Rig::servo, drive, {{{Quantity::motor_torque, constant(0.1)}}, {}}, "torque_driven");
  ASSERT_FALSE(rig);
  EXPECT_THAT(rig.error().message(), testing::HasSubstr("rigid"));
  EXPECT_THAT(rig.error().message(), testing::HasSubstr("compliant"));
}

/// Every effect of the kinematics, with what it needs beside it, in sizes that show.
std::vector<EffectSpec> kinematics() {
  return {{"backlash", {{"half_gap", 1e-4}, {"rounding", 2e-5}}},
          {"kinematic_error", {{"amplitude", 1.5e-4}, {"order", 2.0}, {"phase", 0.3}}},
          {"output_kinematic_error", {{"amplitude", 1e-4}, {"order", 1.0}, {"phase", 0.2}}},
          {"series_compliance", {{"compliance", 4.8e-5}}},
          {"lost_motion", {{"half_gap", 1e-4}, {"width", 9.0}}}};
}

// With torsion it is the free rig, seen from its load.
TEST(ServoRig, MovesAsTheFreeRigWhereItIsCompliant) {
  const RigInputs inputs{{{Quantity::motor_torque, sine(0.4, 2.0)}}, {}};
  for (const EffectSpec& effect : kinematics()) {
    DriveSpec drive = example_drive();
    drive.torsion.effects = {effect};
    const auto servo = made_rig(Rig::servo, drive, inputs, "compliant");
    const auto free = made_rig(Rig::free, drive, inputs);
    const auto times = instants(1.0, 50);
    const std::size_t n = free->states();
    ASSERT_EQ(servo->states(), n);
    const auto y = simulated(*servo, servo->parameter_vector(), times, servo->rest(), 1e-9, 1e-12);
    const auto z = simulated(*free, free->parameter_vector(), times, free->rest(), 1e-9, 1e-12);
    for (std::size_t i = 0; i < times.size(); ++i) {
      EXPECT_NEAR(y[i * n + 2], z[i * n + 2], 1e-9) << effect.effect << " at " << times[i];
    }
  }
}

// A stiff transmission with an error that turns with the output: theta_m = N (theta_l - e), and the
// power of the motor is that of the load.
TEST(ServoRig, TurnsItsLoadThroughAnErrorOfTheKinematics) {
  DriveSpec drive = bare();
  drive.torsion.f = law_spec("odd_polynomial", 1e-3, {}, {1e3});
  drive.torsion.g_inverse = law_spec("odd_polynomial", 1.0, {}, {1e2});
  constexpr double kError = 0.05;
  drive.torsion.effects = {
      {"output_kinematic_error", {{"amplitude", kError}, {"order", 3.0}, {"phase", 0.0}}}};
  const auto rig =
      made_rig(Rig::servo, drive, {{{Quantity::motor_torque, constant(0.02)}}, {}}, "compliant");
  const auto times = instants(1.5, 60);
  const auto y = simulated(*rig, rig->parameter_vector(), times, rig->rest(), 1e-10, 1e-13);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double motor = y[4 * i];
    const double load = y[4 * i + 2];
    EXPECT_NEAR(motor / 20.0 - load + kError * std::sin(3.0 * load), 0.0, 2e-6) << times[i];
    const double energy = 0.5 * drive.motor_inertia * y[4 * i + 1] * y[4 * i + 1] +
                          0.5 * drive.load_inertia * y[4 * i + 3] * y[4 * i + 3];
    EXPECT_NEAR(energy, 0.02 * motor, 1e-4 * (0.02 * motor + 1e-3)) << times[i];
  }
  EXPECT_GT(y[4 * 60 + 2], 1.0) << "turned far enough for the error to show";
}

TEST(ServoRig, IsFedWithVoltageWhereItIsCompliant) {
  auto [drive, inputs] = voltage_step();
  drive.torsion.f = law_spec("odd_polynomial", 1e-3, {}, {1e3});
  drive.torsion.g_inverse = law_spec("odd_polynomial", 1.0, {}, {1e2});
  const auto rig = made_rig(Rig::servo, drive, inputs, "compliant_voltage");
  const auto times = instants(1.0, 20);
  const auto y = simulated(*rig, rig->parameter_vector(), times, rig->rest(), 1e-10, 1e-12);
  const double inertia = drive.motor_inertia + drive.load_inertia / 400.0;
  const double rate = drive.torque_constant * drive.back_emf / (drive.resistance * inertia);
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double speed = 0.5 * 7.4 / drive.back_emf * (1.0 - std::exp(-rate * times[i]));
    EXPECT_NEAR(y[4 * i + 1] / speed, 1.0, 1e-4) << times[i];
  }
}

}  // namespace
}  // namespace flexspline
