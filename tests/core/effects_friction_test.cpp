// The physics of each effect at the motor: friction, heat, actuation.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "effect_paths.hpp"
#include "flexspline/core/effect_path.hpp"
#include "motions.hpp"

namespace flexspline {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

const EffectRow& row_of(std::string_view id) {
  const auto row = find_effect(id);
  EXPECT_TRUE(row) << id;
  return **row;
}

/// The term of a static effect.
double term(std::string_view id, const std::vector<double>& p, const Instant<double>& x) {
  const EffectRow& row = row_of(id);
  EXPECT_EQ(p.size() % row.parameters.size(), 0u) << id;
  return row.real.term(x, p, {});
}

Instant<double> at_speed(double w) {
  Instant<double> x;
  x.motor_speed = w;
  x.gear_ratio = 50.0;
  return x;
}

Instant<double> loaded(double w, double torque, double motor_torque = 0.0) {
  Instant<double> x = at_speed(w);
  x.transmitted_torque = torque;
  x.motor_torque = motor_torque;
  return x;
}

/// Constant speed from rest at angle 0, one instant every dt.
std::vector<Instant<double>> steady_run(double w, double dt, int samples) {
  std::vector<Instant<double>> path;
  for (int i = 0; i <= samples; ++i) {
    Instant<double> x = at_speed(w);
    x.time = dt * i;
    x.motor_angle = w * x.time;
    path.push_back(x);
  }
  return path;
}

std::vector<double> along(std::string_view id, const std::vector<double>& values,
                          const std::vector<Instant<double>>& path) {
  const EffectRow& row = row_of(id);
  EffectSpec spec{std::string(id), {}};
  for (std::size_t k = 0; k < values.size(); ++k) {
    const auto name = row.parameters[k % row.parameters.size()].name;
    spec.parameters.emplace_back(std::string(name), values[k]);
  }
  const auto terms = terms_along(row, spec, path);
  EXPECT_TRUE(terms) << terms.error().message();
  return terms.value_or(std::vector<double>(path.size(), std::nan("")));
}

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

TEST(MotorTorqueRipple, CoggingAloneStoresWhatItTakes) {
  constexpr int kSteps = 360;
  double work = 0.0;
  double moved = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    Instant<double> x;
    x.motor_angle = kTurn * i / kSteps;
    const double torque = term("motor_torque_ripple", {24.0, 0.03, 0.01, 0.0, 0.0}, x);
    work += torque;
    moved += std::abs(torque);
  }
  EXPECT_NEAR(work / moved, 0.0, 1e-12);
}

TEST(MotorTorqueRipple, ItsScaledPartIsProportionalToTheTorque) {
  Instant<double> x;
  x.motor_angle = 0.7;
  const std::vector<double> p = {6.0, 0.0, 0.0, 0.02, 0.01};
  x.motor_torque = 1.0;
  const double once = term("motor_torque_ripple", p, x);
  EXPECT_NEAR(once, 0.02 * std::sin(4.2) + 0.01 * std::cos(4.2), 1e-15);
  x.motor_torque = -3.0;
  EXPECT_NEAR(term("motor_torque_ripple", p, x), -3.0 * once, 1e-15);
}

TEST(ThermalFrictionDrift, HalvesInLn2TimeConstants) {
  const std::vector<double> p = {0.03, 4e-4, 1800.0, 0.5};
  Instant<double> x = at_speed(50.0);
  EXPECT_NEAR(term("thermal_friction_drift", p, x), 0.05, 1e-12);
  x.time = 1800.0 * std::numbers::ln2;
  EXPECT_NEAR(term("thermal_friction_drift", p, x), 0.025, 1e-12);
}

// tc, B, bc, bv, C, G, q, we. Slopes 0: the loss is constant, the temperature an exponential.
TEST(ThermalState, WarmsUpExponentiallyAtConstantLossWhateverTheSampling) {
  const std::vector<double> p = {0.0, 1e-3, 0.0, 0.0, 2000.0, 1.1, 2.0, 0.5};
  const double power = 1e-3 * 100.0 * 100.0 + 2.0 * 1.5 * 1.5;
  for (double dt : {0.1, 50.0, 3000.0}) {
    const int samples = static_cast<int>(6000.0 / dt);
    auto path = steady_run(100.0, dt, samples);
    for (auto& x : path) x.motor_torque = 1.5;
    std::vector<double> state = {0.0};
    for (int i = 1; i <= samples; ++i) {
      const auto k = static_cast<std::size_t>(i);
      row_of("thermal_state").real.advance(path[k - 1], path[k], p, state);
      const double expected = power / 1.1 * -std::expm1(-1.1 * path[k].time / 2000.0);
      ASSERT_NEAR(state[0], expected, 1e-10) << "at " << path[k].time << " s";
    }
  }
}

TEST(ThermalState, SettlesWhereTheLossLeavesThroughTheConductance) {
  const std::vector<double> p = {0.06, 1e-3, 0.01, 0.035, 2000.0, 1.1, 0.0, 0.5};
  const auto path = steady_run(200.0, 10.0, 4000);
  std::vector<double> state = {0.0};
  double last = row_of("thermal_state").real.term(path[0], p, state);
  for (std::size_t i = 1; i < path.size(); ++i) {
    row_of("thermal_state").real.advance(path[i - 1], path[i], p, state);
    const double now = row_of("thermal_state").real.term(path[i], p, state);
    ASSERT_LE(now, last) << "friction falls as it warms up";
    last = now;
  }
  EXPECT_NEAR(1.1 * state[0], last * 200.0, 1e-6 * last * 200.0);
  EXPECT_NEAR(last, 0.06 * std::exp(-0.01 * state[0]) + 0.2 * std::exp(-0.035 * state[0]), 1e-12);
}

// A ramp of slope s from a settled start is followed s T (1 - exp(-t/T)) behind.
TEST(CurrentLag, FollowsARampBehindByItsTimeConstant) {
  const double slope = 40.0;
  const double lag = 2e-3;
  for (double dt : {1e-5, 1e-3, 7e-3}) {
    auto path = steady_run(0.0, dt, static_cast<int>(0.03 / dt));
    for (auto& x : path) x.motor_torque = 1.3 + slope * x.time;
    const auto behind = along("current_lag", {lag}, path);
    for (std::size_t i = 0; i < path.size(); ++i) {
      EXPECT_NEAR(behind[i], -slope * lag * std::expm1(-path[i].time / lag), 1e-13);
    }
  }
}

// tau_m - q is tau_m through 1/(1 + i w T).
TEST(CurrentLag, IsAFirstOrderLowPass) {
  const double w = 300.0;
  const double lag = 2e-3;
  auto path = steady_run(0.0, 1e-5, 10000);
  for (auto& x : path) x.motor_torque = std::cos(w * x.time);
  const auto behind = along("current_lag", {lag}, path);
  const Complex response = 1.0 / Complex(1.0, w * lag);
  for (std::size_t i = 5000; i < path.size(); i += 7) {
    const double passed = (response * std::polar(1.0, w * path[i].time)).real();
    EXPECT_NEAR(path[i].motor_torque - behind[i], passed, 1e-5);
  }
}

TEST(TorqueConstantError, ScalesTheRecordedTorque) {
  for (double torque : {-3.0, 0.5}) {
    const auto x = loaded(0.0, 0.0, torque);
    EXPECT_NEAR(torque - term("torque_constant_error", {0.05}, x), 1.05 * torque, 1e-15);
  }
}

double true_torque(double softening, double recorded) {
  return recorded - term("torque_saturation", {softening}, loaded(0.0, 0.0, recorded));
}

TEST(TorqueSaturation, LosesItsShareAtThePeakAndNeverTurnsOver) {
  const double peak = 11.4;
  const double softening = 0.06 / (peak * peak);
  EXPECT_NEAR(true_torque(softening, peak), 0.94 * peak, 1e-12);
  EXPECT_NEAR(true_torque(softening, -peak / 2.0), -0.985 * peak / 2.0, 1e-12);
  double last = 0.0;
  for (double torque = 0.1; torque < 200.0; torque += 0.1) {
    const double now = true_torque(softening, torque);
    EXPECT_GE(now, last - 1e-12) << torque;
    last = now;
  }
  EXPECT_NEAR(last, 2.0 / (3.0 * std::sqrt(3.0 * softening)), 1e-10);
}

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

}  // namespace
}  // namespace flexspline
