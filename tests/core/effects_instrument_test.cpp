// Effects of the instruments, against their closed forms.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "effect_paths.hpp"
#include "flexspline/core/effect_path.hpp"

namespace flexspline {
namespace {

/// What the instrument shows of a signal along a path.
std::vector<double> shown(const std::string& id, const Parameters& parameters,
                          const std::vector<Instant<double>>& path,
                          double Instant<double>::*channel) {
  std::vector<double> signal;
  for (const auto& x : path) signal.push_back(x.*channel);
  const auto row = find_effect(id);
  EXPECT_TRUE(row);
  EXPECT_TRUE(apply_along(**row, {id, parameters}, path, signal));
  return signal;
}

TEST(TorqueSensorGain, ScalesTheReading) {
  const auto path = drive_path(1.0, 100, 1);
  const auto torque =
      shown("torque_sensor_gain", {{"error", -0.02}}, path, &Instant<double>::transmitted_torque);
  for (std::size_t i = 0; i < path.size(); ++i) {
    EXPECT_NEAR(torque[i], 0.98 * path[i].transmitted_torque, 1e-12);
  }
}

TEST(TorqueSensorDrift, StartsAtZeroSettlesAndGoesOnAtItsRate) {
  std::vector<Instant<double>> path(4);
  path[1].time = 1e-3;
  path[2].time = 1e4;
  path[3].time = 2e4;
  const auto torque =
      shown("torque_sensor_drift", {{"rate", 1e-3}, {"settling", 0.5}, {"time_constant", 100.0}},
            path, &Instant<double>::transmitted_torque);
  EXPECT_EQ(torque[0], 0.0);
  EXPECT_NEAR(torque[1] / 1e-3, 1e-3 + 0.5 / 100.0, 1e-7);
  EXPECT_NEAR(torque[2], 10.0 + 0.5, 1e-12);
  EXPECT_NEAR(torque[3] - torque[2], 10.0, 1e-12);
}

TEST(SensorCrosstalk, ComesTwiceATurnOfTheMotorWithoutTorque) {
  for (double turns : {0.0, 0.5, 1.0, 3.5}) {
    Instant<double> x;
    x.motor_angle = 0.1 + 2.0 * std::numbers::pi * turns;
    const auto torque =
        shown("sensor_crosstalk", {{"amplitude", 2.0}, {"order", 2.0}, {"phase", 0.5}}, {x},
              &Instant<double>::transmitted_torque);
    EXPECT_NEAR(torque[0], 2.0 * std::sin(0.7), 1e-12);
  }
}

TEST(EncoderSkew, ShowsTheLoadLateAndToFirstOrderBySpeedTimesDelay) {
  constexpr double kDelay = 1.3e-3;
  std::vector<Instant<double>> path(2000);
  for (std::size_t i = 0; i < path.size(); ++i) {
    path[i].time = 1e-3 * static_cast<double>(i);
    path[i].load_angle = std::sin(9.0 * path[i].time);
    path[i].load_speed = 9.0 * std::cos(9.0 * path[i].time);
  }
  const auto angle = shown("encoder_skew", {{"delay", kDelay}}, path, &Instant<double>::load_angle);
  const auto terms =
      terms_along(**find_effect("encoder_skew"), {"encoder_skew", {{"delay", kDelay}}}, path);
  ASSERT_TRUE(terms);
  for (std::size_t i = 10; i < path.size(); ++i) {
    EXPECT_NEAR(angle[i], std::sin(9.0 * (path[i].time - kDelay)), 1e-6);
    EXPECT_NEAR((*terms)[i], angle[i] - path[i].load_angle, 0.6 * std::pow(9.0 * kDelay, 2));
  }
}

TEST(EncoderSkew, LeavesARecordingOfTwoSamples) {
  std::vector<Instant<double>> path(2);
  path[1].time = path[1].load_angle = 1.0;
  EXPECT_EQ(shown("encoder_skew", {{"delay", 0.1}}, path, &Instant<double>::load_angle),
            (std::vector<double>{0.0, 1.0}));
}

TEST(EncoderEccentricity, ErrsOnceATurnOfItsOwnShaft) {
  const Parameters off_centre = {{"amplitude", 1e-4}, {"phase", 0.3}};
  Instant<double> x;
  x.motor_angle = 40.0;
  x.load_angle = 0.9;
  const auto load = shown("encoder_eccentricity", off_centre, {x}, &Instant<double>::load_angle);
  const auto motor =
      shown("motor_encoder_eccentricity", off_centre, {x}, &Instant<double>::motor_angle);
  EXPECT_NEAR(load[0] - 0.9, 1e-4 * std::sin(1.2), 1e-15);
  EXPECT_NEAR(motor[0] - 40.0, 1e-4 * std::sin(40.3), 1e-13);
}

struct Quantiser {
  std::string id;
  double Instant<double>::*channel;
};

// A sweep over many steps: multiples of the step, at most half a step off, q^2/12 on average.
TEST(Quantisation, RoundsToTheNearestStep) {
  for (const auto& [id, channel] :
       {Quantiser{"encoder_quantisation", &Instant<double>::load_angle},
        {"motor_encoder_quantisation", &Instant<double>::motor_angle},
        {"torque_quantisation", &Instant<double>::transmitted_torque}}) {
    constexpr double kStep = 0.03;
    std::vector<Instant<double>> path(30001);
    for (std::size_t i = 0; i < path.size(); ++i) {
      path[i].*channel = -1.5 + 1e-4 * static_cast<double>(i);
    }
    const auto signal = shown(id, {{"step", kStep}}, path, channel);
    double square = 0.0;
    for (std::size_t i = 0; i < path.size(); ++i) {
      const double error = signal[i] - path[i].*channel;
      EXPECT_LE(std::abs(error), 0.5 * kStep + 1e-12);
      EXPECT_NEAR(std::remainder(signal[i], kStep), 0.0, 1e-12);
      square += error * error / static_cast<double>(path.size());
    }
    EXPECT_NEAR(square, kStep * kStep / 12.0, 1e-3 * kStep * kStep) << id;
    const auto fine = shown(id, {{"step", 0.0}}, path, channel);
    EXPECT_EQ(fine[12345], path[12345].*channel) << id;
  }
}

std::vector<Instant<double>> torque_cycle(double amplitude, int samples) {
  std::vector<Instant<double>> path(static_cast<std::size_t>(2 * samples + 1));
  for (std::size_t i = 0; i < path.size(); ++i) {
    path[i].time = static_cast<double>(i) / samples;
    path[i].transmitted_torque = amplitude * std::sin(2.0 * std::numbers::pi * path[i].time);
  }
  return path;
}

TEST(TorqueSensorNonlinearity, HasACubicAndAHysteresisOfItsHeight) {
  constexpr int kPerCycle = 40000;
  for (double amplitude : {5.0, 30.0, 100.0}) {
    const auto path = torque_cycle(amplitude, kPerCycle);
    const auto torque =
        shown("torque_sensor_nonlinearity", {{"cubic", 2e-6}, {"hysteresis", 0.2}, {"width", 10.0}},
              path, &Instant<double>::transmitted_torque);
    double area = 0.0;
    for (std::size_t i = kPerCycle + 1; i < path.size(); ++i) {
      area += 0.5 * (torque[i] + torque[i - 1]) *
              (path[i].transmitted_torque - path[i - 1].transmitted_torque);
    }
    EXPECT_NEAR(area, 4.0 * 0.2 * std::max(amplitude - 10.0, 0.0), 1e-4);
    const std::size_t top = kPerCycle + kPerCycle / 4;
    const double full = 0.2 * std::min(amplitude / 10.0, 1.0);
    EXPECT_NEAR(torque[top] - amplitude, 2e-6 * std::pow(amplitude, 3) + full, 1e-9);
  }
}

}  // namespace
}  // namespace flexspline
