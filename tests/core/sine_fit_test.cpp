#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "flexspline/core/signals.hpp"

namespace flexspline {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

struct Samples {
  std::vector<double> time;
  std::vector<double> signal;
};

// 3 - 0.7 cos(2 pi f t + 0.4) on samples that are not quite even, from 11 s on.
Samples sine(double frequency, double cycles) {
  Samples s;
  constexpr int kCount = 1500;
  for (int i = 0; i < kCount; ++i) {
    const double t = 11.0 + cycles / frequency * (i + 0.2 * std::sin(i)) / kCount;
    s.time.push_back(t);
    s.signal.push_back(3.0 - 0.7 * std::cos(kTwoPi * frequency * t + 0.4));
  }
  return s;
}

void expect_the_sine(const SineFit& fit, double frequency) {
  EXPECT_NEAR(fit.frequency_hz / frequency, 1.0, 1e-10);
  EXPECT_NEAR(fit.amplitude, 0.7, 1e-9);
  EXPECT_NEAR(fit.mean, 3.0, 1e-9);
  EXPECT_NEAR(std::cos(fit.phase - 0.4), -1.0, 1e-9);
  EXPECT_NEAR(fit.explained, 1.0, 1e-12);
}

TEST(FitSine, IsExactFromAWrongGuess) {
  for (double wrong : {0.96, 1.0, 1.05}) {
    const auto s = sine(0.005, 4.3);
    expect_the_sine(fit_sine(s.time, s.signal, wrong * 0.005), 0.005);
  }
}

TEST(FitSine, FindsTheFrequencyByItself) {
  for (double frequency : {0.005, 0.3, 40.0}) {
    for (double cycles : {1.6, 4.0, 25.0}) {
      const auto s = sine(frequency, cycles);
      expect_the_sine(fit_sine(s.time, s.signal, std::nullopt), frequency);
    }
  }
}

// Of a sine and its third harmonic over whole cycles the sine explains A^2/(A^2 + B^2), and a
// little more by leaning its frequency on the harmonic.
TEST(FitSine, SaysWhatShareASineExplains) {
  Samples s;
  for (int i = 0; i < 2000; ++i) {
    const double t = 5.0 * i / 2000.0;
    s.time.push_back(t);
    s.signal.push_back(std::sin(kTwoPi * t) + 0.5 * std::sin(3.0 * kTwoPi * t));
  }
  const auto fit = fit_sine(s.time, s.signal, 1.0);
  EXPECT_NEAR(fit.explained, 1.0 / 1.25, 3e-3);
  EXPECT_NEAR(fit.amplitude, 1.0, 5e-3);
}

}  // namespace
}  // namespace flexspline
