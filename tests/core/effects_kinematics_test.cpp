// Effects of the kinematics and of the load against their closed forms.
#include <cmath>
#include <complex>

#include <gtest/gtest.h>

#include "effect_terms.hpp"

namespace flexspline {
namespace {

// Over 25 turns the orders 2 and 2.04 are orthogonal: each projection finds its own amplitude.
TEST(KinematicError, HasTheAmplitudeAndPhaseOfEachOrder) {
  constexpr int kSamples = 20000;
  auto angle = grid(0.0, 50.0 * kPi, kSamples);
  angle.pop_back();
  const auto error = terms_of("kinematic_error",
                              {{"amplitude", 1.5e-4},
                               {"order", 2.0},
                               {"phase", 0.4},
                               {"amplitude", 0.6e-4},
                               {"order", 2.04},
                               {"phase", -1.0}},
                              along(&Instant<double>::motor_angle, angle));
  const auto projection = [&](double order) {
    std::complex<double> sum = 0.0;
    for (std::size_t i = 0; i < angle.size(); ++i) {
      sum += error[i] * std::polar(2.0 / kSamples, -order * angle[i]);
    }
    return sum * std::complex<double>(0.0, 1.0);
  };
  EXPECT_NEAR(std::abs(projection(2.0) - std::polar(1.5e-4, 0.4)), 0.0, 1e-15);
  EXPECT_NEAR(std::abs(projection(2.04) - std::polar(0.6e-4, -1.0)), 0.0, 1e-15);
  for (double order : {1.0, 2.08, 4.0}) EXPECT_NEAR(std::abs(projection(order)), 0.0, 1e-15);
}

TEST(OutputKinematicError, TurnsWithTheOutputAlone) {
  Instant<double> x;
  x.motor_angle = 17.0;
  x.load_angle = 0.7;
  const Parameters once = {{"amplitude", 1e-4}, {"order", 1.0}, {"phase", 0.2}};
  EXPECT_NEAR(term_at("output_kinematic_error", once, x), 1e-4 * std::sin(0.9), 1e-18);
  x.motor_angle = -4.0;
  x.load_angle += 2.0 * kPi;
  EXPECT_NEAR(term_at("output_kinematic_error", once, x), 1e-4 * std::sin(0.9), 1e-18);
}

TEST(LoadDependentKinematicError, GrowsWithTheTorque) {
  const Parameters twice = {{"compliance", 3e-7}, {"order", 2.0}, {"phase", 0.0}};
  Instant<double> x;
  x.motor_angle = 0.25 * kPi;
  EXPECT_EQ(term_at("load_dependent_kinematic_error", twice, x), 0.0);
  x.transmitted_torque = -113.0;
  EXPECT_NEAR(term_at("load_dependent_kinematic_error", twice, x), -113.0 * 3e-7, 1e-18);
}

TEST(StiffnessRipple, ChangesTheStiffnessTwiceATurnAndNotItsMean) {
  const Parameters twice = {{"stiffness", 3000.0}, {"order", 2.0}, {"phase", 0.0}};
  double sum = 0.0;
  for (int i = 0; i < 360; ++i) {
    Instant<double> x;
    x.motor_angle = i * kPi / 180.0;
    x.torsion = 1e-3;
    const double torque = term_at("stiffness_ripple", twice, x);
    EXPECT_NEAR(torque, 3.0 * std::sin(2.0 * x.motor_angle), 1e-12);
    sum += torque;
  }
  EXPECT_NEAR(sum, 0.0, 1e-10);
}

TEST(GravityLoad, LiftsByTwiceItsMomentInHalfATurnAndReturnsItInAWholeOne) {
  const Parameters pendulum = {{"moment", 11.0}, {"phase", 0.3}};
  for (const auto& [to, lifted] : {std::pair{kPi, 22.0}, std::pair{2.0 * kPi, 0.0}}) {
    const auto angle = grid(-0.3, to - 0.3, 20000);
    const auto torque =
        terms_of("gravity_load", pendulum, along(&Instant<double>::load_angle, angle));
    EXPECT_NEAR(integral(torque, angle), lifted, 1e-6);
  }
}

TEST(LoadFriction, IsCoulombAndViscousAndOpposesTheMotion) {
  const Parameters seal = {{"coulomb", 1.5}, {"viscous", 0.8}, {"width", 0.01}};
  for (double speed : {-2.0, -0.5, 0.5, 2.0}) {
    Instant<double> x;
    x.load_speed = speed;
    EXPECT_NEAR(term_at("load_friction", seal, x), std::copysign(1.5, speed) + 0.8 * speed, 1e-12);
  }
  Instant<double> creeping;
  creeping.load_speed = 1e-6;
  EXPECT_NEAR(term_at("load_friction", seal, creeping), 1e-6 * (150.0 + 0.8), 1e-12);
}

}  // namespace
}  // namespace flexspline
