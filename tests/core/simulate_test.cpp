// Eq. (4) and eq. (3) undo each other, and follow closed forms where there are any.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "flexspline/core/simulate.hpp"
#include "law_examples.hpp"
#include "motions.hpp"

namespace flexspline {
namespace {

using testing::HasSubstr;

LawSpec unity() { return law_spec("bounded_modulation", 1.0, {}, {}); }

ModelSpec linear(double stiffness, double damping) {
  return {.f = law_spec("odd_polynomial", 1.0, {}, {stiffness}),
          .g_inverse = law_spec("odd_polynomial", 1.0, {}, {damping}),
          .h = unity(),
          .effects = {}};
}

/// Shaped like Table I's laws over amplitude 1 and speed 2 pi, and increasing everywhere.
ModelSpec polynomial_gear() {
  return {.f = law_spec("odd_polynomial", 1.0, {}, {4.8, 11.8}),
          .g_inverse = law_spec("odd_polynomial", 6.3, {}, {1.0, 3.5}),
          .h = law_spec("bounded_modulation", 1.0, {}, {0.1, 0.3}),
          .effects = {}};
}

ModelSpec spline_gear() {
  return {.f = law_spec("monotone_spline", 1.02, {0.25, 0.5, 0.75}, {2., 3., 5., 9., 12., 14.}),
          .g_inverse = law_spec("monotone_spline", 7.2, {0.2, 0.5},
                                {1.0, 2.0, 3.0, 5.0, 6.0, 1.5, 2.5, 3.5, 4.0, 7.0}),
          .h = unity(),
          .effects = {}};
}

// Largest difference between a motion and what comes back of it through torque.
double round_trip_error(const ModelSpec& model, int per_cycle, double tolerance) {
  const auto motion = harmonic_motion({1.0}, per_cycle, 2);
  const auto torque = simulate_torque(model, motion);
  EXPECT_TRUE(torque);
  const auto torsion = simulate_torsion(model, motion.time, *torque, motion.position.front(),
                                        {tolerance, tolerance, 2000000});
  EXPECT_TRUE(torsion) << torsion.error().message();
  double worst = 0.0;
  for (std::size_t i = 0; i < torsion->size(); ++i) {
    worst = std::max(worst, std::abs((*torsion)[i] - motion.position[i]));
  }
  return worst;
}

TEST(Simulation, ThereAndBackGivesTheMotion) {
  EXPECT_LT(round_trip_error(polynomial_gear(), 4000, 1e-10), 1e-7);
  EXPECT_LT(round_trip_error(spline_gear(), 4000, 1e-10), 1e-6);
}

// What is left is the spline through the samples of the torque: third order or better.
TEST(Simulation, ThereAndBackConvergesWithTheSampling) {
  const double coarse = round_trip_error(polynomial_gear(), 100, 1e-12);
  const double fine = round_trip_error(polynomial_gear(), 200, 1e-12);
  const double finer = round_trip_error(polynomial_gear(), 400, 1e-12);
  EXPECT_GT(std::log2(coarse / fine), 2.5);
  EXPECT_GT(std::log2(fine / finer), 2.5);
}

struct Drive {
  std::vector<double> time;
  std::vector<double> torque;
  std::vector<double> torsion;
};

// phi' = (T sin wt - k phi)/c from rest.
Drive linear_sine(double k, double c, int count) {
  Drive d;
  constexpr double kTorque = 2.0;
  constexpr double kRate = 3.0;
  const double scale = kTorque / (k * k + c * c * kRate * kRate);
  for (int i = 0; i <= count; ++i) {
    const double t = 6.0 * i / count;
    d.time.push_back(t);
    d.torque.push_back(kTorque * std::sin(kRate * t));
    d.torsion.push_back(scale * (k * std::sin(kRate * t) - c * kRate * std::cos(kRate * t) +
                                 c * kRate * std::exp(-k * t / c)));
  }
  return d;
}

double worst(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

TEST(SimulateTorsion, FollowsTheFirstOrderResponseToASine) {
  const auto d = linear_sine(5.0, 1.5, 6000);
  const auto torsion = simulate_torsion(linear(5.0, 1.5), d.time, d.torque, 0.0,
                                        {.relative_tolerance = 1e-10, .absolute_tolerance = 1e-10});
  ASSERT_TRUE(torsion);
  EXPECT_LT(worst(*torsion, d.torsion), 1e-8);
}

TEST(SimulateTorsion, CreepsToItsRestUnderAConstantTorque) {
  Drive d;
  for (int i = 0; i <= 500; ++i) {
    const double t = 0.01 * i;
    d.time.push_back(t);
    d.torque.push_back(3.0);
    d.torsion.push_back(0.6 + (0.2 - 0.6) * std::exp(-5.0 / 1.5 * t));
  }
  const auto torsion = simulate_torsion(linear(5.0, 1.5), d.time, d.torque, 0.2,
                                        {.relative_tolerance = 1e-10, .absolute_tolerance = 1e-10});
  ASSERT_TRUE(torsion);
  EXPECT_LT(worst(*torsion, d.torsion), 1e-8);
}

TEST(SimulateTorsion, ErrsInProportionToItsTolerance) {
  const auto d = linear_sine(5.0, 1.5, 20000);
  double last = 1.0;
  for (double tolerance : {1e-4, 1e-6, 1e-8}) {
    const auto torsion =
        simulate_torsion(linear(5.0, 1.5), d.time, d.torque, 0.0, {tolerance, tolerance, 200000});
    ASSERT_TRUE(torsion);
    const double error = worst(*torsion, d.torsion);
    EXPECT_LT(error, 100.0 * tolerance);
    EXPECT_LT(error, 0.1 * last);
    last = error;
  }
}

TEST(SimulateTorsion, StaysTheSameInOtherUnits) {
  const auto d = linear_sine(5.0, 1.5, 2000);
  ModelSpec small = polynomial_gear();
  for (LawSpec* law : {&small.f, &small.g_inverse, &small.h}) law->scale *= 1e-3;
  const auto one = simulate_torsion(polynomial_gear(), d.time, d.torque, 0.1);
  const auto other = simulate_torsion(small, d.time, d.torque, 0.1e-3);
  ASSERT_TRUE(one && other);
  for (std::size_t i = 0; i < one->size(); ++i) EXPECT_NEAR((*one)[i], 1e3 * (*other)[i], 1e-7);
}

TEST(SimulateTorsion, RefusesEffects) {
  ModelSpec model = linear(5.0, 1.5);
  model.effects = {{"inertia_torque", {{"inertia", 1.0}}}};
  const auto d = linear_sine(5.0, 1.5, 20);
  const auto torsion = simulate_torsion(model, d.time, d.torque, 0.0);
  ASSERT_FALSE(torsion);
  EXPECT_EQ(torsion.error().code, ErrorCode::bad_data);
  EXPECT_THAT(torsion.error().message(), HasSubstr("inertia_torque"));
}

// v - v^3 never reaches 1: no speed answers to the torque.
TEST(SimulateTorsion, SaysWhereItStoppedWithoutASolution) {
  ModelSpec model = linear(5.0, 1.5);
  model.g_inverse.coefficients = {1.0, -1.0};
  const auto d = linear_sine(5.0, 1.5, 100);
  const auto torsion = simulate_torsion(model, d.time, d.torque, 0.0);
  ASSERT_FALSE(torsion);
  EXPECT_EQ(torsion.error().code, ErrorCode::numerics);
  EXPECT_THAT(torsion.error().message(), HasSubstr("stopped at t = "));
}

TEST(SimulateTorque, IsTheSumOfItsParts) {
  ModelSpec model = linear(5.0, 1.5);
  const auto motion = harmonic_motion({1.0, 0.4}, 100);
  model.effects = {{"torque_sensor_offset", {{"offset", 0.25}}},
                   {"inertia_torque", {{"inertia", 0.1}}}};
  const auto torque = simulate_torque(model, motion);
  ASSERT_TRUE(torque);
  for (std::size_t i = 0; i < torque->size(); ++i) {
    EXPECT_NEAR(
        (*torque)[i],
        5.0 * motion.position[i] + 1.5 * motion.velocity[i] + 0.1 * motion.acceleration[i] + 0.25,
        1e-12);
  }
}

// The delay of the sensor acts on all that it measures, in whatever order the effects stand.
TEST(SimulateTorque, AppliesTheInstrumentAfterEveryForce) {
  ModelSpec model = linear(5.0, 1.5);
  const auto motion = harmonic_motion({1.0, 0.4}, 500);
  const EffectSpec delay{"sensor_delay", {{"delay", 0.02}}};
  const EffectSpec inertia{"inertia_torque", {{"inertia", 0.1}}};
  model.effects = {delay, inertia};
  const auto one = simulate_torque(model, motion);
  model.effects = {inertia, delay};
  const auto other = simulate_torque(model, motion);
  ASSERT_TRUE(one && other);
  EXPECT_EQ(*one, *other);
}

TEST(SimulateTorque, RefusesWhatItCannotMake) {
  const auto motion = harmonic_motion({1.0}, 10);
  const auto refusal = [&](auto change) {
    ModelSpec model = linear(5.0, 1.5);
    change(model);
    const auto torque = simulate_torque(model, motion);
    return torque ? std::string() : torque.error().message();
  };
  EXPECT_THAT(refusal([](ModelSpec& m) { m.h.law = "k"; }), HasSubstr("'k'"));
  EXPECT_THAT(refusal([](ModelSpec& m) { m.effects = {{"drift", {}}}; }), HasSubstr("'drift'"));
  EXPECT_THAT(refusal([](ModelSpec& m) {
                m.effects = {{"inertia_torque", {}}};
              }),
              HasSubstr("inertia_torque has 0 parameters"));
  EXPECT_THAT(refusal([](ModelSpec& m) {
                m.effects = {{"presliding_hysteresis", {{"stiffness", 1.0}}}};
              }),
              HasSubstr("2 an element"));
}

}  // namespace
}  // namespace flexspline
