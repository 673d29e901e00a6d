// The physics of presliding friction at the motor.
#include <cmath>

#include <gtest/gtest.h>

#include "motions.hpp"
#include "motor_instants.hpp"

namespace flexspline {
namespace {

const std::vector<double> kLuGre = {0.06, 0.018, 10.0, 0.02, 0.05};

// Ten slip lengths of steady sliding leave the Stribeck curve, and no more of the damping.
TEST(LuGreFriction, SlidesOnItsStribeckCurve) {
  for (double w : {0.1, 5.0, 10.0, 60.0, -10.0}) {
    const auto path = steady_run(w, 1.0 / std::abs(w), 1);
    const double level = 0.06 + 0.018 * std::exp(-w * w / 100.0);
    EXPECT_NEAR(along("lugre_friction", kLuGre, path).back(), std::copysign(level, w), 1e-12);
  }
}

TEST(LuGreFriction, IsASpringThatYieldsExponentiallyAtConstantSpeed) {
  std::vector<double> p = kLuGre;
  p[4] = 0.0;
  const double w = 5.0;
  const double level = 0.06 + 0.018 * std::exp(-0.25);
  for (double dt : {1e-5, 1e-3}) {
    const auto path = steady_run(w, dt, static_cast<int>(0.02 / dt));
    const auto torque = along("lugre_friction", p, path);
    for (std::size_t i = 0; i < path.size(); ++i) {
      const double slip = 0.06 / 0.02 * path[i].motor_angle / level;
      EXPECT_NEAR(torque[i], -level * std::expm1(-slip), 1e-12);
    }
  }
}

// Were the damping constant, it would give energy back where the bristles are bent further than the
// speed holds them: 10 times nominal here.
TEST(LuGreFriction, TakesMoreThanItStoresAtEveryState) {
  const EffectRow& row = row_of("lugre_friction");
  std::vector<double> p = kLuGre;
  p[4] = 0.5;
  for (double w : {-80.0, -3.0, -0.1, 0.02, 1.0, 12.0, 200.0}) {
    for (double share = -1.3; share <= 1.3; share += 0.1) {
      const std::vector<double> z = {share * 0.02};
      std::vector<double> dz = {0.0};
      row.real.rate(at_speed(w), p, z, dz);
      const double stored = 0.06 / 0.02 * z[0] * dz[0];
      EXPECT_GE(row.real.term(at_speed(w), p, z) * w - stored, -1e-15) << w << " " << share;
    }
  }
}

constexpr double kStep = 1.0 / 1024.0;  // exact in binary: elements yield on samples

std::vector<Instant<double>> motor_path(const std::vector<double>& turns) {
  return instants_of(zigzag(turns, kStep));
}

// Stiffness, yield, excess, Stribeck speed, lag; at a speed of 1e-3 rad/s all is quasi-static.
const std::vector<double> kElements = {3.0, 1.0 / 64.0, 0.3, 1e3, 5e-3,
                                       1.0, 5.0 / 64.0, 0.5, 1e3, 5e-3};

TEST(GmsFriction, ClosesMinorLoopsAndForgetsThem) {
  const auto straight = along("gms_friction", kElements, motor_path({0.0, 0.25, 0.125, 0.25}));
  const auto detour = along("gms_friction", kElements,
                            motor_path({0.0, 0.25, 0.1875, 0.21875, 0.1875, 0.125, 0.25}));
  ASSERT_GT(detour.size(), straight.size());
  for (std::size_t i = 0; i <= 128 + 64; ++i) {  // back to where the detour left, and beyond
    EXPECT_NEAR(detour[detour.size() - 1 - i], straight[straight.size() - 1 - i], 1e-12) << i;
  }
}

TEST(GmsFriction, IsMaxwellSlipWithoutTheStribeckPeak) {
  const auto path = motor_path({0.0, 0.125, -0.0625, 0.03125, -0.25});
  const auto gms =
      along("gms_friction", {3.0, 0.015625, 0.0, 10.0, 5e-3, 1.0, 0.07, 0.0, 10.0, 5e-3}, path);
  const auto stops = along("presliding_hysteresis", {3.0, 0.015625, 1.0, 0.07}, path);
  for (std::size_t i = 0; i < path.size(); ++i) EXPECT_NEAR(gms[i], stops[i], 1e-13);
}

TEST(GmsFriction, SlidesOnItsStribeckCurve) {
  const std::vector<double> p = {3.0, 0.02, 0.3, 10.0, 5e-3};
  for (double w : {0.5, 10.0, -40.0}) {
    const double level = 0.06 * (1.0 + 0.3 * std::exp(-w * w / 100.0));
    const auto path = steady_run(w, 1e-3, 200);
    EXPECT_NEAR(along("gms_friction", p, path).back(), std::copysign(level, w), 1e-12);
  }
}

// After a jump of speed the friction goes to its new level over the lag, not at once.
TEST(GmsFriction, LagsBehindTheSpeed) {
  const std::vector<double> p = {3.0, 0.02, 0.3, 10.0, 5e-3};
  const double slow = 0.06 * (1.0 + 0.3 * std::exp(-0.01));
  const double fast = 0.06 * (1.0 + 0.3 * std::exp(-4.0));
  std::vector<double> state = {slow / 3.0};
  const auto path = steady_run(20.0, 1e-3, 30);
  for (std::size_t i = 1; i < path.size(); ++i) {
    row_of("gms_friction").real.advance(path[i - 1], path[i], p, state);
    const double expected = fast + (slow - fast) * std::exp(-path[i].time / 5e-3);
    EXPECT_NEAR(3.0 * state[0], expected, 1e-12) << path[i].time;
  }
}

/// The same path under torques that go evenly from one value to another.
std::vector<Instant<double>> under_load(std::vector<Instant<double>> path, double from, double to) {
  for (std::size_t i = 0; i < path.size(); ++i) {
    path[i].transmitted_torque =
        from + (to - from) * static_cast<double>(i) / static_cast<double>(path.size() - 1);
    path[i].gear_ratio = 1.0;
  }
  return path;
}

// Coefficient, yield, width of the magnitude.
const std::vector<double> kLoaded = {0.06, 1.0 / 64.0, 1e-9, 0.02, 5.0 / 64.0, 1e-9};

TEST(PreslidingLoadFriction, IsMaxwellSlipUnderAConstantLoad) {
  const auto path = under_load(motor_path({0.0, 0.125, -0.0625, 0.03125, -0.25}), -200.0, -200.0);
  const auto friction = along("presliding_load_friction", kLoaded, path);
  const auto stops =
      along("presliding_hysteresis",
            {0.06 * 200.0 * 64.0, 1.0 / 64.0, 0.02 * 200.0 * 12.8, 5.0 / 64.0}, path);
  for (std::size_t i = 0; i < path.size(); ++i) EXPECT_NEAR(friction[i], stops[i], 1e-6);
}

TEST(PreslidingLoadFriction, SlidesAsLoadDependentFriction) {
  const auto path = under_load(motor_path({0.0, 0.5}), 20.0, 220.0);
  const auto memory = along("presliding_load_friction", {0.06, 1.0 / 64.0, 1e-9}, path);
  const auto sign = along("load_dependent_friction", {0.06, 1e-9, 1e-9}, path);
  for (std::size_t i = 17; i + 1 < path.size(); ++i) EXPECT_NEAR(memory[i], sign[i], 1e-7) << i;
}

// Wound at a load T1 and let go at T2 an element returns mu r (T2 - T1)/2 more than it took.
TEST(PreslidingLoadFriction, GivesBackMoreOnlyForWhatTheLoadPutIn) {
  const double yield = 1.0 / 64.0;
  const auto out = under_load(motor_path({0.0, yield}), 50.0, 50.0);
  auto back = under_load(motor_path({yield, 0.0}), 200.0, 200.0);
  auto path = out;
  path.insert(path.end(), back.begin(), back.end());
  const auto torque = along("presliding_load_friction", {0.06, yield, 1e-9}, path);
  double work = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double step = path[i].motor_angle - path[i - 1].motor_angle;
    work += 0.5 * (torque[i] + torque[i - 1]) * step;
  }
  EXPECT_NEAR(work, -0.06 * yield * 150.0 / 2.0, 1e-9);
}

}  // namespace
}  // namespace flexspline
