// The physics of heat and of actuation at the motor.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "motor_instants.hpp"

namespace flexspline {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

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

}  // namespace
}  // namespace flexspline
