// What the counts of an encoder tell of a motion, and what they leave of it.
#include "flexspline/core/counts.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "signals/smoothing.hpp"

namespace flexspline {
namespace {

constexpr double kLevel = 3.8349519697e-4;  // of 14 bit
constexpr double kStep = 0.0027;
constexpr std::size_t kSamples = 3000;

std::vector<double> sampled(const std::function<double(double)>& motion) {
  std::vector<double> samples;
  for (std::size_t i = 0; i < kSamples; ++i) {
    samples.push_back(motion(kStep * static_cast<double>(i)));
  }
  return samples;
}

std::vector<double> counted(const std::function<double(double)>& motion) {
  return sampled([&](double t) { return kLevel * std::round(motion(t) / kLevel); });
}

double root_mean_square(const std::vector<double>& x) {
  double sum = 0.0;
  for (std::size_t i = 50; i + 50 < x.size(); ++i) sum += x[i] * x[i];
  return std::sqrt(sum / static_cast<double>(x.size() - 100));
}

TEST(Counts, HaveALevel) {
  EXPECT_NEAR(level_of_counts(counted([](double t) { return std::sin(t); })), kLevel,
              1e-9 * kLevel);
}

TEST(Counts, PrintedWithFewDigitsHaveALevel) {
  const auto printed = [](double x) { return 1e-6 * std::round(1e6 * x); };
  auto samples = counted([](double t) { return std::sin(8.0 * t); });  // of up to 56 levels a step
  for (double& x : samples) x = printed(x);
  EXPECT_NEAR(level_of_counts(samples), kLevel, 1e-3 * kLevel);
}

TEST(Counts, AreNoSamplesOfASineOrARampThatIsNotCounted) {
  EXPECT_EQ(level_of_counts(sampled([](double t) { return std::sin(t); })), 0.0);
  EXPECT_EQ(level_of_counts(sampled([](double t) { return 0.3 * t; })), 0.0);
  EXPECT_EQ(level_of_counts(sampled([](double) { return 0.3; })), 0.0);
}

// Read every third sample, and a line between: what lasts are counts, what lies between is none.
TEST(Counts, ThatWereInterpolatedOnAGridHaveALevel) {
  auto samples = counted([](double t) { return 0.02 * std::sin(t); });
  for (std::size_t i = 0; i + 3 < samples.size(); i += 3) {
    samples[i + 1] = samples[i] + (samples[i + 3] - samples[i]) / 3.0;
    samples[i + 2] = samples[i] + (samples[i + 3] - samples[i]) / 1.5;
  }
  EXPECT_NEAR(level_of_counts(samples), kLevel, 1e-6 * kLevel);
  EXPECT_GT(deviation_of_counts(samples), 0.2 * kLevel / std::sqrt(12.0)) << "at least";
}

// A value that comes twice, as where a sensor missed one, or at the end of its range, is no count.
TEST(Counts, AreNotWhatLastsForOtherReasons) {
  const auto sine = [](double t) { return std::sin(t); };
  auto missed = sampled(sine);
  for (std::size_t i = 7; i < missed.size(); i += 13) missed[i] = missed[i - 1];
  EXPECT_EQ(level_of_counts(missed), 0.0);
  auto clipped = sampled(sine);
  for (double& x : clipped) x = std::clamp(x, -0.9, 0.9);
  EXPECT_EQ(level_of_counts(clipped), 0.0);
}

TEST(Counts, LeaveATwelfthOfASquareLevelWhereTheyAreAllPassed) {
  for (const double speed : {0.02, 0.437}) {  // slower and faster than a level a sample
    const auto samples = counted([&](double t) { return speed * t; });
    EXPECT_NEAR(deviation_of_counts(samples), kLevel / std::sqrt(12.0), 0.01 * kLevel) << speed;
  }
}

TEST(Counts, OfAMotionThatRestsTellNothing) {
  const auto half_at_rest = [](double t) { return 0.2 * std::min(t, 0.5 * kStep * kSamples); };
  EXPECT_NEAR(deviation_of_counts(counted(half_at_rest)), kLevel / std::sqrt(24.0), 0.01 * kLevel);
  // Down and up again between two levels.
  const auto between = [](double t) { return kLevel * (0.5 + 0.6 * std::sin(3.0 * t)); };
  EXPECT_EQ(deviation_of_counts(counted(between)), 0.0);
}

// At 3.08 levels a sample the error of counting is a sawtooth of twelve samples: to
// cross-validation, which takes noise for white, a motion. Its second derivative, followed, were
// that of a triangle of a level: some kLevel (2 pi / 12 samples)^2.
TEST(Counts, AtASteadySpeedAreNoMotion) {
  const auto samples = counted([](double t) { return 3.0801 * kLevel * t / kStep; });
  std::vector<double> time;
  for (std::size_t i = 0; i < kSamples; ++i) time.push_back(kStep * static_cast<double>(i));
  for (const auto resolution : {Resolution::fine, Resolution::even}) {
    const auto smooth = smooth_by_spline(time, samples, resolution);
    ASSERT_TRUE(smooth.has_value());
    EXPECT_GT(smooth->noise, 0.9 * kLevel / std::sqrt(12.0));
    EXPECT_LT(root_mean_square(smooth->second), 0.01 * kLevel * std::pow(0.52 / kStep, 2.0));
  }
}

}  // namespace
}  // namespace flexspline
