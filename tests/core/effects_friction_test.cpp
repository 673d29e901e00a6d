// The physics of each friction without memory at the motor.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "motor_instants.hpp"

namespace flexspline {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

TEST(CoulombViscousFriction, IsTheDryAndTheViscousPartOfEquation5) {
  const std::vector<double> p = {0.06, 6e-4, 0.5};
  for (double w : {5.0, 40.0, 200.0}) {
    EXPECT_NEAR(term("coulomb_viscous_friction", p, at_speed(w)), 0.06 + 6e-4 * w, 1e-9);
    EXPECT_NEAR(term("coulomb_viscous_friction", p, at_speed(-w)), -0.06 - 6e-4 * w, 1e-9);
  }
  EXPECT_LT(0.06 - term("coulomb_viscous_friction", {0.06, 0.0, 0.5}, at_speed(1.35)), 0.01 * 0.06);
}

TEST(StribeckFriction, PeaksAtZeroSpeedAndFallsFromThere) {
  const std::vector<double> p = {0.02, 10.0, 2.0, 0.5};
  double peak = 0.0;
  double where = 0.0;
  for (double w = 0.01; w < 30.0; w += 0.01) {
    const double now = term("stribeck_friction", p, at_speed(w));
    if (now > peak) where = w;
    peak = std::max(peak, now);
  }
  EXPECT_GT(peak, 0.95 * 0.02);
  EXPECT_LT(peak, 0.02);
  EXPECT_LT(where, 0.15 * 10.0);
  double last = term("stribeck_friction", p, at_speed(where));
  for (double w = where + 0.1; w < 30.0; w += 0.1) {
    const double now = term("stribeck_friction", p, at_speed(w));
    EXPECT_LT(now, last) << w;
    last = now;
  }
}

TEST(StribeckFriction, LeavesOneEthAtItsSpeedWhateverTheExponent) {
  for (double exponent : {0.5, 1.0, 2.0, 3.5}) {
    const std::vector<double> p = {0.02, 10.0, exponent, 0.5};
    EXPECT_NEAR(term("stribeck_friction", p, at_speed(10.0)), 0.02 * std::exp(-1.0), 1e-15);
    EXPECT_NEAR(term("stribeck_friction", p, at_speed(-10.0)), -0.02 * std::exp(-1.0), 1e-15);
  }
}

TEST(NonlinearViscousFriction, IsHomogeneousBeyondItsSmoothing) {
  for (double n : {0.5, 2.0 / 3.0, 1.0, 2.0}) {
    const std::vector<double> p = {3e-3, n, 0.5};
    for (double w : {10.0, -60.0}) {
      const double error = 2.0 * 0.5 * std::abs(n - 1.0) * 0.25 / (w * w);  // as its range says
      const double once = term("nonlinear_viscous_friction", p, at_speed(w));
      const double thrice = term("nonlinear_viscous_friction", p, at_speed(3.0 * w));
      EXPECT_NEAR(thrice / once, std::pow(3.0, n), std::pow(3.0, n) * error + 1e-12);
      EXPECT_NEAR(std::abs(once), 3e-3 * std::pow(std::abs(w), n), std::abs(once) * error + 1e-12);
    }
  }
}

TEST(NonlinearViscousFriction, IsViscousAtExponentOneAndNearRest) {
  EXPECT_NEAR(term("nonlinear_viscous_friction", {6e-4, 1.0, 0.5}, at_speed(7.0)), 42e-4, 1e-15);
  const std::vector<double> p = {3e-3, 2.0 / 3.0, 0.5};
  EXPECT_NEAR(term("nonlinear_viscous_friction", p, at_speed(1e-4)) / 1e-4,
              3e-3 * std::pow(0.5, -1.0 / 3.0), 1e-9);
}

TEST(LoadDependentFriction, GrowsWithTheLoadWhateverItsSign) {
  const std::vector<double> p = {0.06, 0.5, 0.5};
  for (double torque : {50.0, 100.0, 226.0}) {
    const double friction = term("load_dependent_friction", p, loaded(30.0, torque));
    EXPECT_LE(friction, 0.06 * torque / 50.0);
    EXPECT_NEAR(friction, 0.06 * torque / 50.0, 0.06 * 0.5 / 50.0);
    EXPECT_EQ(term("load_dependent_friction", p, loaded(30.0, -torque)), friction);
    EXPECT_EQ(term("load_dependent_friction", p, loaded(-30.0, torque)), -friction);
  }
}

// At constant speed the friction over the torque is a butterfly: two straight wings each way.
TEST(LoadDependentFriction, DrawsAButterfly) {
  const std::vector<double> p = {0.06, 1e-3, 1e-9};
  for (double torque = -200.0; torque <= 200.0; torque += 40.0) {
    for (double w : {-5.0, 5.0}) {
      EXPECT_NEAR(term("load_dependent_friction", p, loaded(w, torque)),
                  std::copysign(0.06 * std::abs(torque) / 50.0, w), 1e-10);
    }
  }
}

/// Motor torque of a steady run under a load, with directional friction as the only loss.
double steady_motor_torque(const std::vector<double>& p, double w, double torque) {
  double motor = torque / 50.0;
  for (int i = 0; i < 60; ++i) {
    motor = torque / 50.0 + term("directional_load_friction", p, loaded(w, torque, motor));
  }
  return motor;
}

// (1 - km) tau_m = (1 + ke) tau/N driving, (1 + km) tau_m = (1 - ke) tau/N driven back.
TEST(DirectionalLoadFriction, HasAnEfficiencyForEachDirection) {
  const double km = 0.3;
  const double ke = 0.1;
  const std::vector<double> p = {km, ke, 0.5, 1e-9};
  for (double torque : {20.0, 200.0}) {
    const double load = torque / 50.0;
    EXPECT_NEAR(steady_motor_torque(p, 30.0, torque), load * (1.0 + ke) / (1.0 - km), 1e-8);
    EXPECT_NEAR(steady_motor_torque(p, -30.0, torque), load * (1.0 - ke) / (1.0 + km), 1e-8);
  }
}

TEST(DirectionalLoadFriction, WithoutMotorShareIsTheLinearOne) {
  for (double torque : {-120.0, 3.0, 200.0}) {
    EXPECT_NEAR(term("directional_load_friction", {0.0, 0.06, 0.5, 1e-9}, loaded(9.0, torque, 2.0)),
                term("load_dependent_friction", {0.06, 0.5, 1e-9}, loaded(9.0, torque)), 1e-9);
  }
}

TEST(QuadraticLoadFriction, FollowsTheWeakerSideSquaredAtLowSpeed) {
  const std::vector<double> p = {0.02, 0.01, 1e6, 0.5, 1e-4};
  for (double torque : {50.0, 100.0}) {
    const double load = torque / 50.0;
    EXPECT_NEAR(term("quadratic_load_friction", p, loaded(9.0, torque, 1.5 * load)),
                0.01 * load * load, 1e-7);
    EXPECT_NEAR(term("quadratic_load_friction", p, loaded(9.0, torque, 0.5 * load)),
                0.02 * 0.25 * load * load, 1e-7);
    EXPECT_NEAR(term("quadratic_load_friction", p, loaded(9.0, torque, -1.5 * load)), 0.0, 1e-7);
  }
}

TEST(QuadraticLoadFriction, FadesAtItsStribeckSpeed) {
  const auto slow = term("quadratic_load_friction", {0.02, 0.01, 1e6, 0.5, 0.1}, loaded(90, 99, 3));
  const auto fast = term("quadratic_load_friction", {0.02, 0.01, 90., 0.5, 0.1}, loaded(90, 99, 3));
  EXPECT_NEAR(fast / slow, std::exp(-1.0), 1e-6);
}

TEST(DirectionAsymmetry, IsEvenInSpeedAndATwinOfAnOffsetWhileMoving) {
  const std::vector<double> p = {6e-3, 0.0, 0.5};
  const double offset = term("motor_torque_offset", {6e-3}, at_speed(0.0));
  for (double w : {3.0, 40.0, 150.0}) {
    EXPECT_EQ(term("direction_asymmetry", p, at_speed(w)),
              term("direction_asymmetry", p, at_speed(-w)));
    EXPECT_NEAR(term("direction_asymmetry", p, at_speed(w)), offset, 1e-4 * offset);
  }
  EXPECT_EQ(term("direction_asymmetry", p, at_speed(0.0)), 0.0);
}

// Beside the symmetric friction that its range asks for, the sum takes energy at every speed.
TEST(DirectionAsymmetry, IsPassiveBesideTheSymmetricFriction) {
  for (double w = -100.0; w <= 100.0; w += 0.37) {
    const double sum = term("direction_asymmetry", {-0.06, -6e-4, 0.5}, at_speed(w)) +
                       term("coulomb_viscous_friction", {0.06, 6e-4, 0.5}, at_speed(w));
    EXPECT_GE(w * sum, -1e-15) << w;
  }
}

TEST(PositionDependentFriction, TurnsWithTheDirectionAndCoggingDoesNot) {
  for (double angle = 0.0; angle < kTurn; angle += 0.3) {
    Instant<double> forward = at_speed(20.0);
    forward.motor_angle = angle;
    Instant<double> backward = forward;
    backward.motor_speed = -20.0;
    const std::vector<double> friction = {1.0, 4e-3, 1e-3, 0.5, 2.0, 6e-3, -2e-3, 0.5};
    const double there = term("position_dependent_friction", friction, forward);
    EXPECT_EQ(term("position_dependent_friction", friction, backward), -there);
    EXPECT_NEAR(there,
                4e-3 * std::sin(angle) + 1e-3 * std::cos(angle) + 6e-3 * std::sin(2.0 * angle) -
                    2e-3 * std::cos(2.0 * angle),
                1e-15);
    const std::vector<double> ripple = {24.0, 0.03, 0.01, 0.02, 0.0};
    EXPECT_EQ(term("motor_torque_ripple", ripple, backward),
              term("motor_torque_ripple", ripple, forward));
  }
}

// At rest it is directional friction, whose shares die with speed.
TEST(StribeckLoadFriction, IsDirectionalFrictionNearRestAndDiesWithSpeed) {
  const std::vector<double> p = {0.3, 0.1, 10.0, 2.0, 1e-6, 1e-9};
  const double squeeze = 0.3 * 2.0 + 0.1 * 40.0 / 50.0;
  const auto at = [&](double w) { return term("stribeck_load_friction", p, loaded(w, 40.0, 2.0)); };
  EXPECT_NEAR(at(1e-3), squeeze, 1e-7);
  EXPECT_NEAR(at(1e-3),
              term("directional_load_friction", {0.3, 0.1, 1e-6, 1e-9}, loaded(1e-3, 40.0, 2.0)),
              1e-7);
  EXPECT_NEAR(at(10.0), squeeze * std::exp(-1.0), 1e-8);
  EXPECT_EQ(at(-10.0), -at(10.0));
  EXPECT_NEAR(at(100.0), 0.0, 1e-12);
}

}  // namespace
}  // namespace flexspline
