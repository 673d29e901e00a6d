// The smooth signals behind noisy records, against the signals they were made of.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "flexspline/core/signals.hpp"
#include "loop_records.hpp"

namespace flexspline {
namespace {

double law(double x, double v) { return 5.0 * x + 0.4 * x * x * x + 0.1 * v; }

double rms_difference(const std::vector<double>& a, const std::vector<double>& b, std::size_t from,
                      std::size_t to) {
  double sum = 0.0;
  for (std::size_t i = from; i < to; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(to - from));
}

std::vector<double> exact_velocity(const TorsionRecord& record) {
  std::vector<double> v;
  for (double t : record.time) {
    v.push_back(4.0 * std::numbers::pi * std::cos(2.0 * std::numbers::pi * t));
  }
  return v;
}

TorsionRecord noisy(TorsionRecord record, unsigned seed) {
  add_noise(record.motion, 0.01, 2 * seed);
  add_noise(record.effort, 0.07, 2 * seed + 1);
  return record;
}

TEST(Reconstruct, MeasuresTheNoiseOfALoop) {
  const auto clean = sine_record(4, 300, law);
  for (unsigned seed : {1U, 2U, 3U}) {
    const auto smooth = reconstruct(noisy(clean, seed));
    ASSERT_TRUE(smooth);
    ASSERT_TRUE(smooth->steady);
    EXPECT_NEAR(smooth->motion_noise / 0.01, 1.0, 0.1);
    EXPECT_NEAR(smooth->effort_noise / 0.07, 1.0, 0.1);
  }
}

// Forty harmonics of two short cycles take a fifth of the noise with them; their count gives it
// back.
TEST(Reconstruct, CountsWhatSmoothingTookOfTheNoise) {
  const auto clean = sine_record(2, 240, law);
  double motion = 0.0;
  double effort = 0.0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const auto smooth = reconstruct(noisy(clean, seed));
    ASSERT_TRUE(smooth);
    motion += std::pow(smooth->motion_noise / 0.01, 2) / 20.0;
    effort += std::pow(smooth->effort_noise / 0.07, 2) / 20.0;
  }
  // Three standard errors of the mean of twenty variances of four hundred samples.
  EXPECT_NEAR(motion, 1.0, 3.0 * std::sqrt(2.0 / (20.0 * 400.0)));
  EXPECT_NEAR(effort, 1.0, 3.0 * std::sqrt(2.0 / (20.0 * 400.0)));
}

TEST(Reconstruct, IsOffByItsStatedError) {
  const auto clean = sine_record(4, 300, law);
  const std::size_t n = clean.time.size();
  for (unsigned seed : {1U, 2U, 3U}) {
    const auto smooth = reconstruct(noisy(clean, seed));
    ASSERT_TRUE(smooth);
    const double stated = smooth->motion_error[n / 2];
    const double made = rms_difference(smooth->motion.position, clean.motion, 0, n);
    EXPECT_LT(made, 2.5 * stated);
    EXPECT_GT(made, 0.2 * stated);
    // The two coefficients of one harmonic have the variance 2 sigma^2/n each; the derivative
    // multiplies by its angular frequency.
    const double velocity = rms_difference(smooth->motion.velocity, exact_velocity(clean), 0, n);
    const double w = 2.0 * std::numbers::pi;
    EXPECT_LT(velocity, 3.0 * w * 0.01 * std::sqrt(2.0 / static_cast<double>(n)));
  }
}

TEST(Reconstruct, FollowsARecordThatDoesNotRepeat) {
  TorsionRecord record;
  record.id = "chirp";
  std::vector<double> clean, velocity;
  for (int i = 0; i <= 3000; ++i) {
    const double t = i / 300.0;
    record.time.push_back(t);
    clean.push_back(std::sin(t + 0.15 * t * t) + 0.2 * t);
    velocity.push_back((1.0 + 0.3 * t) * std::cos(t + 0.15 * t * t) + 0.2);
  }
  record.motion = clean;
  record.effort = clean;
  record.valid.assign(clean.size(), true);
  add_noise(record.motion, 0.01, 5);
  add_noise(record.effort, 0.03, 6);
  const auto smooth = reconstruct(record);
  ASSERT_TRUE(smooth);
  EXPECT_FALSE(smooth->steady);
  EXPECT_NEAR(smooth->motion_noise / 0.01, 1.0, 0.1);
  EXPECT_NEAR(smooth->effort_noise / 0.03, 1.0, 0.1);
  const double made = rms_difference(smooth->motion.position, clean, 0, clean.size());
  EXPECT_LT(made, 2.5 * smooth->motion_error[1500]);
  EXPECT_GT(made, 0.2 * smooth->motion_error[1500]);
  // Away from the ends; the derivative of noise would be 0.01 * sqrt(2) * 300 = 4.
  EXPECT_LT(rms_difference(smooth->motion.velocity, velocity, 60, clean.size() - 60), 0.03);
}

// Cycles that wander by less than makes them unsteady still differ by more than noise: one cycle
// for all would be off by the wander, 0.07.
TEST(Reconstruct, KeepsEveryCycleWhereCyclesDiffer) {
  auto record = sine_record(6, 300, law);
  for (std::size_t i = 0; i < record.time.size(); ++i)
    record.motion[i] += 0.1 * std::sin(2.3 * record.time[i]);
  const auto clean = record.motion;
  add_noise(record.motion, 0.003, 7);
  add_noise(record.effort, 0.07, 8);
  const auto smooth = reconstruct(record);
  ASSERT_TRUE(smooth);
  ASSERT_TRUE(smooth->steady);
  EXPECT_LT(rms_difference(smooth->motion.position, clean, 0, clean.size()), 0.003);
}

// A run-up by the spline and a steady part by its harmonics make one motion without a jump.
TEST(Reconstruct, JoinsTheRunUpToTheLoop) {
  auto record = sine_record(6, 300, law);
  for (std::size_t i = 0; i < 600; ++i) {
    const double u = static_cast<double>(i) / 600.0;
    record.motion[i] *= u * u * (3.0 - 2.0 * u);
    record.effort[i] *= u * u * (3.0 - 2.0 * u);
  }
  const auto clean = record.motion;
  add_noise(record.motion, 0.01, 8);
  add_noise(record.effort, 0.07, 9);
  const auto smooth = reconstruct(record);
  ASSERT_TRUE(smooth);
  ASSERT_TRUE(smooth->steady);
  EXPECT_GT(smooth->steady->first, 300U);
  for (std::size_t i = 1; i < clean.size(); ++i) {
    EXPECT_NEAR(smooth->motion.position[i], clean[i], 0.03) << i;
    const double dt = record.time[i] - record.time[i - 1];
    const double step = smooth->motion.position[i] - smooth->motion.position[i - 1];
    EXPECT_NEAR(step / dt, smooth->motion.velocity[i], 1.5) << i;  // of 12.6
  }
}

TEST(Reconstruct, RefusesWhatHoldsNoMotion) {
  auto record = sine_record(4, 100, law);
  record.id = "stuck";
  for (double& x : record.motion) x = 0.3;
  auto smooth = reconstruct(record);
  ASSERT_FALSE(smooth);
  EXPECT_EQ(smooth.error().code, ErrorCode::numerics);
  EXPECT_THAT(smooth.error().message(), testing::HasSubstr("recording stuck does not move"));

  auto brief = sine_record(1, 10, law);
  smooth = reconstruct(brief);
  ASSERT_FALSE(smooth);
  EXPECT_THAT(smooth.error().message(), testing::HasSubstr("11 samples"));
}

}  // namespace
}  // namespace flexspline
