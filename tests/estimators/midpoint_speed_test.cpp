// Pairing at equal phi where the motion is no pure sine: what the measured speed recovers, and the
// analytic error of the pure sine's.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "flexspline/estimators/midpoint_locus.hpp"
#include "gears.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kOmega = 2.0 * std::numbers::pi * kFrequency;
constexpr double kThird = 0.03;
// Harmonics move the period that a fitted sine has over four cycles, and cycles that are averaged
// with it smear by this much.
constexpr double kPeriod = 4e-3;

/// Two cosines: amplitude of the third harmonic, and of the second with the phases of a bench.
struct Harmonics {
  double third = kThird;
  double third_phase = 0.0;
  double second = 0.0;
  double second_phase = 0.0;

  double motion(double angle) const {
    return kAmplitude * (std::cos(angle) + third * std::cos(3.0 * angle + third_phase) +
                         second * std::cos(2.0 * angle + second_phase));
  }
  double speed(double angle) const {
    return -kSpeed * (std::sin(angle) + 3.0 * third * std::sin(3.0 * angle + third_phase) +
                      2.0 * second * std::sin(2.0 * angle + second_phase));
  }
};

TorsionRecord distorted(const Gear& gear, const Harmonics& shape) {
  constexpr int kPerCycle = 2000;
  TorsionRecord record;
  record.id = "distorted";
  record.frequency_hz = kFrequency;
  for (int i = 0; i < 4 * kPerCycle; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kPerCycle;
    record.time.push_back(angle / kOmega);
    record.motion.push_back(shape.motion(angle));
    record.effort.push_back(gear.f(shape.motion(angle)) + gear.g_inverse(shape.speed(angle)));
  }
  record.valid.assign(record.time.size(), true);
  return record;
}

const Gear kCubic = {.f =
                         [](double phi) {
                           const double x = phi / kAmplitude;
                           return (4.81 + 11.77 * x * x) * x;
                         },
                     .g_inverse =
                         [](double speed) {
                           const double z = speed / kSpeed;
                           return (2.0 + 2.5 * z * z) * z;
                         }};
const Options kMeasured = {.numbers = {}, .words = {{"speed", "measured"}}};

// Symmetric in time: the branches have equal and opposite speeds, and the fitted sine is the first
// harmonic. The locus then lies exactly on f and g^-1, over the speed
// sin(a) + 3 (B/A) sin(3a), while the sine has sqrt(1 - (phi/A)^2), 1/(1 - 3 B/A) too much at
// phi = 0, and none where |phi| > A.
TEST(MidpointSpeed, PureSineHasTheAnalyticError) {
  const Harmonics shape;
  const auto record = distorted(kCubic, shape);
  const auto sine = midpoint_locus(record, LocusSpeed::pure_sine);
  const auto measured = midpoint_locus(record, LocusSpeed::measured);
  ASSERT_TRUE(sine && measured);
  double worst = 0.0;
  // Towards its turns the speed is the root of phi, and of every error in it.
  for (std::size_t k = 10; k + 10 < sine->motion.size(); ++k) {
    const double x = sine->motion[k] / kAmplitude;
    double from = 0.0, to = std::numbers::pi;
    for (int step = 0; step < 60; ++step) {
      const double middle = 0.5 * (from + to);
      (shape.motion(middle) > sine->motion[k] + sine->centre ? from : to) = middle;
    }
    const double speed = -shape.speed(from);
    EXPECT_NEAR(sine->distance[k], kCubic.g_inverse(speed), kPeriod * 4.5);
    EXPECT_NEAR(measured->rising_rate[k], speed, kPeriod * kSpeed);
    EXPECT_NEAR(measured->falling_rate[k], speed, kPeriod * kSpeed);
    EXPECT_NEAR(sine->rising_rate[k], kSpeed * std::sqrt(std::max(0.0, 1.0 - x * x)),
                kPeriod * kSpeed);
    worst = std::max(worst, sine->rising_rate[k] / speed);
  }
  EXPECT_GE(worst, 1.0 / (1.0 - 3.0 * kThird) - kPeriod);
}

// The harmonics of the virtual bench: the branches differ in speed, and the measured one recovers
// odd laws of five terms all the same.
TEST(MidpointSpeed, MeasuredRecoversOddLaws) {
  const auto record = distorted(kCubic, {kThird, 0.7, 0.02, 0.4});
  const auto measured = fitted("midpoint_polynomial", {record}, kMeasured);
  const auto sine = fitted("midpoint_polynomial", {record});
  ASSERT_TRUE(measured && sine);
  EXPECT_LT(worst_error(measured->model.g_inverse, kCubic.g_inverse, kSpeed), kPeriod);
  EXPECT_LT(worst_error(measured->model.f, kCubic.f, kAmplitude), kPeriod / 10.0);
  EXPECT_GT(worst_error(sine->model.g_inverse, kCubic.g_inverse, kSpeed), 0.03);
}

TEST(MidpointSpeed, PoolingAddsWhatASmallerLoopShows) {
  auto small = distorted(kCubic, {kThird, 0.7, 0.02, 0.4});
  small.id = "slower";
  for (double& t : small.time) t *= 2.0;
  small.frequency_hz = 0.5 * kFrequency;
  for (std::size_t i = 0; i < small.time.size(); ++i) {
    const double angle = kOmega * 0.5 * small.time[i];
    const Harmonics shape{kThird, 0.7, 0.02, 0.4};
    small.effort[i] = kCubic.f(shape.motion(angle)) + kCubic.g_inverse(0.5 * shape.speed(angle));
  }
  const auto pooled =
      fitted("midpoint_pooled", {distorted(kCubic, {kThird, 0.7, 0.02, 0.4}), small}, kMeasured);
  ASSERT_TRUE(pooled) << pooled.error().message();
  EXPECT_EQ(pooled->fits.size(), 2U);
  EXPECT_LT(worst_error(pooled->model.g_inverse, kCubic.g_inverse, kSpeed), kPeriod);
}

TEST(MidpointSpeed, RefusesALoopWithSmallerTurnsWithin) {
  const auto estimate =
      fitted("midpoint_polynomial", {distorted(kCubic, {0.5, 0.0, 0.0, 0.0})}, kMeasured);
  ASSERT_FALSE(estimate);
  EXPECT_THAT(estimate.error().message(),
              testing::AllOf(testing::HasSubstr("distorted turns more than twice a cycle"),
                             testing::HasSubstr("record a loop that turns at its ends alone")));
}

}  // namespace
}  // namespace flexspline::estimators
