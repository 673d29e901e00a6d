// What no smooth curve can follow is an error, not a crash.
#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "flexspline/core/rig_residuals.hpp"
#include "flexspline/core/signals.hpp"
#include "loop_records.hpp"
#include "signals/smoothing.hpp"

namespace flexspline {
namespace {

using testing::HasSubstr;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<double> seconds(std::size_t n) {
  std::vector<double> time(n);
  for (std::size_t i = 0; i < n; ++i) time[i] = static_cast<double>(i);
  return time;
}

TEST(Smoothing, FollowsAConstantAndWhatIsTiny) {
  for (const double value : {0.0, 3.0, 1e-310}) {
    const auto smooth = smooth_by_spline(seconds(40), std::vector<double>(40, value));
    ASSERT_TRUE(smooth.has_value());
    for (const double x : smooth->value) EXPECT_NEAR(x, value, 1e-9);
  }
}

TEST(Smoothing, RefusesSamplesWhoseSquaresAreNotFinite) {
  for (const double wild : {1e200, -1e155, kInfinity, std::nan("")}) {
    std::vector<double> samples(40, 1.0);
    samples[7] = wild;
    const auto smooth = smooth_by_spline(seconds(40), samples);
    ASSERT_FALSE(smooth.has_value()) << wild;
    EXPECT_EQ(smooth.error().code, ErrorCode::numerics);
    EXPECT_THAT(smooth.error().problem, HasSubstr("not finite or overflow when squared"));
  }
}

TEST(Smoothing, RefusesATimeThatDoesNotIncrease) {
  for (const double wild : {2.0, -1.0, std::nan(""), kInfinity}) {
    std::vector<double> time = seconds(40);
    time[39] = wild;
    const auto smooth = smooth_by_spline(time, std::vector<double>(40, 1.0));
    ASSERT_FALSE(smooth.has_value()) << wild;
    EXPECT_THAT(smooth.error().problem, HasSubstr("time does not increase"));
  }
  EXPECT_FALSE(smooth_by_spline(seconds(15), std::vector<double>(15, 1.0)).has_value());
  EXPECT_FALSE(smooth_by_spline(seconds(40), std::vector<double>(39, 1.0)).has_value());
  EXPECT_FALSE(smooth_by_spline({}, {}).has_value());
}

TEST(Smoothing, IsRefusedOnTheWayToEveryRig) {
  TorsionRecord record = sine_record(4, 100, [](double x, double v) { return x + 0.1 * v; });
  record.id = "wild";
  record.effort[5] = 1e200;
  const auto smooth = reconstruct(record);
  ASSERT_FALSE(smooth.has_value());
  EXPECT_THAT(smooth.error().message(), HasSubstr("recording wild: samples are missing"));
  Recording recording;
  recording.id = "wild";
  recording.time = record.time;
  recording.channels[Quantity::motor_angle] = record.effort;
  recording.channels[Quantity::load_angle] = record.motion;
  const auto channels = drive_channels(Rig::free, {}, recording);
  ASSERT_FALSE(channels.has_value());
  EXPECT_THAT(channels.error().message(), HasSubstr("recording wild: samples are missing"));
}

}  // namespace
}  // namespace flexspline
