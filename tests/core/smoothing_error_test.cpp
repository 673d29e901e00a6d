// How wrong the rate of a smoothing spline is, against the motion itself.
#include <cmath>
#include <functional>
#include <random>

#include <gtest/gtest.h>

#include "signals/smoothing.hpp"

namespace flexspline {
namespace {

constexpr double kStep = 0.01;
constexpr std::size_t kSamples = 3000;

double instant(std::size_t i) { return kStep * static_cast<double>(i); }

SmoothSignal smoothed(const std::function<double(double)>& measured) {
  std::vector<double> time, samples;
  for (std::size_t i = 0; i < kSamples; ++i) {
    time.push_back(instant(i));
    samples.push_back(measured(instant(i)));
  }
  auto smooth = smooth_by_spline(time, samples, Resolution::fine);
  EXPECT_TRUE(smooth.has_value());
  return smooth ? *std::move(smooth) : SmoothSignal{};
}

/// Root mean squares over samples, of the rate's error and of what is said of it.
struct Errors {
  double real = 0.0, told = 0.0;
};

Errors errors(const SmoothSignal& smooth, const std::function<double(double)>& rate,
              const std::function<bool(double)>& counts) {
  Errors e;
  double count = 0.0;
  for (std::size_t i = 50; i + 50 < kSamples; ++i) {
    if (!counts(instant(i))) continue;
    e.real += std::pow(smooth.rate[i] - rate(instant(i)), 2.0);
    e.told += std::pow(smooth.rate_error[i], 2.0);
    count += 1.0;
  }
  return {std::sqrt(e.real / count), std::sqrt(e.told / count)};
}

bool always(double) { return true; }

// Noise alone is told as it is, or a little larger: the larger of two that few samples tell, and a
// part of the error is what smoothing takes of the motion.
TEST(SmoothingError, OfNoiseIsTold) {
  for (const double noise : {1e-4, 1e-2}) {
    std::mt19937_64 random(5);
    std::normal_distribution<double> normal(0.0, noise);
    const auto smooth = smoothed([&](double t) { return std::sin(2.0 * t) + normal(random); });
    const auto [real, told] = errors(
        smooth, [](double t) { return 2.0 * std::cos(2.0 * t); }, always);
    EXPECT_GT(told / real, 0.9) << noise;
    EXPECT_LT(told / real, 1.4) << noise;
  }
}

// Of the second derivative a ninth of the penalty changes noise by 1.76 times itself.
TEST(SmoothingError, OfAnAccelerationIsMoreThanItsNoise) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal(0.0, 1e-3);
  const auto smooth = smoothed([&](double t) { return std::sin(2.0 * t) + normal(random); });
  double real = 0.0, told = 0.0;
  for (std::size_t i = 50; i + 50 < kSamples; ++i) {
    real += std::pow(smooth.second[i] + 4.0 * std::sin(2.0 * instant(i)), 2.0);
    told += std::pow(smooth.second_error[i], 2.0);
  }
  EXPECT_NEAR(std::sqrt(told / real), 1.76, 0.45);
}

// Of the value a ninth of the penalty changes noise by 0.42 times itself; odd and even samples
// tell all of it.
TEST(SmoothingError, OfAValueIsItsNoise) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal(0.0, 1e-3);
  const auto smooth = smoothed([&](double t) { return std::sin(2.0 * t) + normal(random); });
  double real = 0.0, told = 0.0;
  for (std::size_t i = 50; i + 50 < kSamples; ++i) {
    real += std::pow(smooth.value[i] - std::sin(2.0 * instant(i)), 2.0);
    told += std::pow(smooth.value_error[i], 2.0);
  }
  EXPECT_NEAR(std::sqrt(told / real), 1.0, 0.15);
}

// A kick between two samples, which the finest spline runs through: a quarter of what it does to
// the second derivative is told by odd and even samples; no change of the penalty tells any.
TEST(SmoothingError, TellsWhatTurnsFasterThanTheSamples) {
  const double kick = 15.003;
  const auto smooth =
      smoothed([&](double t) { return 50.0 * std::pow(std::max(t - kick, 0.0), 2.0); });
  double real = 0.0, told = 0.0;
  for (std::size_t i = 1495; i < 1507; ++i) {
    real += std::pow(smooth.second[i] - (instant(i) > kick ? 100.0 : 0.0), 2.0) / 12.0;
    told += std::pow(smooth.second_error[i], 2.0) / 12.0;
  }
  real = std::sqrt(real), told = std::sqrt(told);
  EXPECT_GT(real, 5.0);
  EXPECT_GT(told, 0.2 * real);
  EXPECT_LT(smooth.second_error[1000], 1e-3 * told) << "at rest";
}

// |t - 15|: the rate jumps, where no spline does. Within one part of the bandwidth it is wrong by
// far more than elsewhere, and said to be.
TEST(SmoothingError, IsLargestWhereAMotionTurnsAtOnce) {
  std::mt19937_64 random(6);
  std::normal_distribution<double> normal(0.0, 1e-2);
  const auto smooth = smoothed([&](double t) { return std::abs(t - 15.0) + normal(random); });
  const auto rate = [](double t) { return t < 15.0 ? -1.0 : 1.0; };
  const double reach = 1.0 / smooth.bandwidth;
  const auto near = [&](double t) { return std::abs(t - 15.0) < reach; };
  const Errors at = errors(smooth, rate, near);
  const Errors away =
      errors(smooth, rate, [&](double t) { return std::abs(t - 15.0) > 5.0 * reach; });
  EXPECT_GT(at.real, 4.0 * away.real);
  EXPECT_GT(at.told, 4.0 * away.told);
  EXPECT_GT(at.told, 0.2 * at.real) << "most of a jump is never seen";
}

// A slow motion in counts of an encoder: an error of a count that stays for many samples is no
// noise of neighbours, and must not be followed.
TEST(SmoothingError, CountsOfAnEncoderAreNotInterpolated) {
  const double count = 1e-2;
  const auto smooth =
      smoothed([&](double t) { return count * std::round(std::sin(2.0 * t) / count); });
  const Errors e = errors(
      smooth, [](double t) { return 2.0 * std::cos(2.0 * t); }, always);
  // An interpolation has rates of whole counts a sample, 1/s, wrong by 0.3 in the mean.
  EXPECT_LT(e.real, 0.1);
}

}  // namespace
}  // namespace flexspline
