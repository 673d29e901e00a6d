// Second derivatives behind narrower bandwidths than their signal, against closed forms.
#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "signals/smoothing.hpp"

namespace flexspline {
namespace {

constexpr double kStep = 0.01;
constexpr std::size_t kSamples = 6000;
constexpr std::array kTimes = {2.0, 4.0};

/// t^2/2, which no penalty on third differences changes, with a burst that asks for a bandwidth,
/// and noise.
SmoothSignal noisy() {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal(0.0, 1e-3);
  std::vector<double> time, samples;
  for (std::size_t i = 0; i < kSamples; ++i) {
    const double t = kStep * static_cast<double>(i);
    time.push_back(t);
    const double burst = t > 50.0 && t < 55.0 ? 0.1 * std::sin(20.0 * (t - 50.0)) : 0.0;
    samples.push_back(0.5 * t * t + burst + normal(random));
  }
  auto smooth = smooth_by_spline(time, samples, Resolution::fine, kTimes);
  EXPECT_TRUE(smooth.has_value());
  return smooth ? *std::move(smooth) : SmoothSignal{};
}

/// Away from burst and ends.
double rms(const std::vector<double>& x, double about) {
  double sum = 0.0;
  for (std::size_t i = 1000; i < 4000; ++i) sum += std::pow(x[i] - about, 2.0);
  return std::sqrt(sum / 3000.0);
}

double error_of(const std::vector<double>& second) { return rms(second, 1.0); }

TEST(NarrowerSecond, HasTheBandwidthAskedFor) {
  const SmoothSignal smooth = noisy();
  ASSERT_EQ(smooth.narrower.size(), kTimes.size());
  for (std::size_t k = 0; k < kTimes.size(); ++k) {
    EXPECT_NEAR(smooth.narrower[k].bandwidth, smooth.bandwidth / kTimes[k],
                1e-9 * smooth.bandwidth);
  }
}

// The variance of white noise behind H = 1/(1 + (w/b)^6), differentiated twice, is that of
// w^4 H^2: proportional to b^5.
TEST(NarrowerSecond, IsFreerOfNoise) {
  const SmoothSignal smooth = noisy();
  const double own = error_of(smooth.second);
  for (std::size_t k = 0; k < kTimes.size(); ++k) {
    const double told = std::pow(kTimes[k], 2.5);
    EXPECT_NEAR(own / error_of(smooth.narrower[k].second), told, 0.3 * told) << kTimes[k];
  }
}

TEST(NarrowerSecond, ToldErrorsAreOfItsOwn) {
  const SmoothSignal smooth = noisy();
  const double own = rms(smooth.second_error, 0.0) / error_of(smooth.second);
  const double narrower = rms(smooth.narrower[0].error, 0.0) / error_of(smooth.narrower[0].second);
  EXPECT_NEAR(narrower / own, 1.0, 0.35);
}

// Slow and sampled finely, the penalty of the own bandwidth is large, and times the sixth power of
// 32 it would leave nothing of the samples beside its rounding.
TEST(NarrowerSecond, OfASlowMotionSampledFinely) {
  constexpr double kRate = 0.05;  // rad/s
  std::mt19937_64 random(9);
  std::normal_distribution<double> normal(0.0, 0.005);
  std::vector<double> time, samples;
  for (std::size_t i = 0; i < 15000; ++i) {
    time.push_back(0.002 * static_cast<double>(i));
    samples.push_back(std::sin(kRate * time.back()) + normal(random));
  }
  const std::array octaves = {2.0, 4.0, 8.0, 16.0, 32.0};
  const auto smooth = smooth_by_spline(time, samples, Resolution::fine, octaves);
  ASSERT_TRUE(smooth);
  ASSERT_EQ(smooth->narrower.size(), octaves.size());
  for (std::size_t k = 2; k < octaves.size(); ++k) {
    const NarrowerSecond& narrower = smooth->narrower[k];
    for (std::size_t i = 5000; i < 10000; i += 100) {
      const double expected = -kRate * kRate * std::sin(kRate * time[i]);
      EXPECT_NEAR(narrower.second[i], expected, 0.5 * kRate * kRate) << narrower.bandwidth;
    }
  }
}

TEST(NarrowerSecond, LeavesTheSignalAsItIs) {
  std::vector<double> time, samples;
  for (std::size_t i = 0; i < 400; ++i) {
    time.push_back(kStep * static_cast<double>(i));
    samples.push_back(std::sin(3.0 * time.back()) + 1e-3 * std::cos(1e4 * time.back()));
  }
  const auto with = smooth_by_spline(time, samples, Resolution::fine, kTimes);
  const auto without = smooth_by_spline(time, samples, Resolution::fine);
  ASSERT_TRUE(with && without);
  EXPECT_EQ(with->value, without->value);
  EXPECT_EQ(with->second, without->second);
  EXPECT_EQ(with->second_error, without->second_error);
  EXPECT_TRUE(without->narrower.empty());
}

}  // namespace
}  // namespace flexspline
