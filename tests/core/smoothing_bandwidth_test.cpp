// Which share of a fast sine a smoothing spline keeps, against the spline itself.
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "signals/smoothing.hpp"

namespace flexspline {
namespace {

constexpr double kStep = 0.01;

/// A slow motion with noise, and the same with a little of a fast sine: too little to change the
/// penalty.
struct Pair {
  std::vector<double> time, plain, with;

  explicit Pair(double rate, double noise) {
    std::mt19937_64 random(11);
    std::normal_distribution<double> normal(0.0, noise);
    for (std::size_t i = 0; i < 3000; ++i) {
      const double t = kStep * static_cast<double>(i);
      time.push_back(t);
      plain.push_back(std::sin(2.0 * t) + normal(random));
      with.push_back(plain.back() + amplitude * std::sin(rate * t));
    }
  }

  static constexpr double amplitude = 1e-6;
};

// Amplitude of the sine in what smoothing makes of it, over that of the sine.
double kept(double rate, double noise, double& bandwidth) {
  const Pair pair(rate, noise);
  const auto plain = smooth_by_spline(pair.time, pair.plain, Resolution::fine);
  const auto with = smooth_by_spline(pair.time, pair.with, Resolution::fine);
  if (!plain || !with) return NAN;
  bandwidth = plain->bandwidth;
  double sine = 0.0, cosine = 0.0, count = 0.0;
  for (std::size_t i = 300; i < 2700; ++i) {
    const double change = with->value[i] - plain->value[i];
    sine += change * std::sin(rate * pair.time[i]);
    cosine += change * std::cos(rate * pair.time[i]);
    count += 0.5;
  }
  return std::hypot(sine, cosine) / count / Pair::amplitude;
}

TEST(SmoothingBandwidth, TellsWhatIsKeptOfASine) {
  double bandwidth = 0.0;
  kept(1.0, 1e-3, bandwidth);
  ASSERT_GT(bandwidth, 4.0);
  ASSERT_LT(bandwidth, 0.7 * std::numbers::pi / (3.0 * kStep)) << "below the knots' own limit";
  for (const double part : {0.5, 0.8, 1.0, 1.25}) {
    double again = 0.0;
    EXPECT_NEAR(kept(part * bandwidth, 1e-3, again), 1.0 / (1.0 + std::pow(part, 6.0)), 0.05)
        << part;
    EXPECT_DOUBLE_EQ(again, bandwidth);
  }
}

// There is a knot at each sample: what they show is followed where next to no noise is on it.
TEST(SmoothingBandwidth, EndsWithTheSamples) {
  const double end = std::numbers::pi / kStep;
  double bandwidth = 0.0;
  EXPECT_GT(kept(0.5 * end, 1e-9, bandwidth), 0.9);
  EXPECT_LE(bandwidth, 1.01 * end);
  EXPECT_GT(bandwidth, 0.5 * end);
}

}  // namespace
}  // namespace flexspline
