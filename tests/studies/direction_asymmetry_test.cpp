// A friction that slips before it slides and is larger one way than the other, told from an offset.
#include <cmath>
#include <numbers>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnosis_checks.hpp"
#include "flexspline/core/stop_operator.hpp"
#include "numbered_sine.hpp"

namespace flexspline::studies {
namespace {

constexpr double kDifference = 0.15;
constexpr double kOffset = 0.4;
constexpr double kNoise = 0.05;

/// A sine that holds still for the first third of its time: friction is at rest there, an offset is
/// not.
Recording recording_of(double amplitude, double frequency, unsigned seed) {
  Recording r = numbered_sine(amplitude, frequency, seed);
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, kNoise);
  std::normal_distribution<double> jitter(0.0, 1e-6);
  StopOperator soft(2e-3);
  StopOperator stiff(5e-4);
  const double moving = 4.0 / frequency;
  const double step = moving / 2000.0;
  double last = 0.0;
  for (int i = 0; i < 3000; ++i) {
    const double t = step * i - 0.5 * moving;
    const double x = t > 0.0 ? amplitude * std::pow(std::min(t * frequency, 1.0), 3) *
                                   std::sin(2.0 * std::numbers::pi * frequency * t)
                             : 0.0;
    const double slipping = 2000.0 * soft.advance(x - last) + 6000.0 * stiff.advance(x - last);
    last = x;
    r.time.push_back(step * i);
    r.channels[Quantity::torsion].push_back(x + jitter(random));
    r.channels[Quantity::torque].push_back(800.0 * x + slipping + kDifference * std::abs(slipping) +
                                           kOffset + noise(random));
  }
  return r;
}

RecordingSet damper() {
  RecordingSet set;
  set.name = "damper";
  set.rig = Rig::specimen;
  unsigned seed = 1;
  for (double amplitude : {0.004, 0.01, 0.02}) {
    for (double frequency : {0.1, 0.5}) {
      set.recordings.push_back(recording_of(amplitude, frequency, seed++));
    }
  }
  return set;
}

TEST(DirectionAsymmetry, OfAFrictionWithMemoryIsToldFromAnOffset) {
  const Diagnosis d = diagnosed(damper());
  EXPECT_THAT(names(d),
              testing::UnorderedElementsAre("presliding_hysteresis", "direction_asymmetry"))
      << d.says;
  const auto cause = std::ranges::find(d.causes, "direction_asymmetry", &Cause::effect);
  ASSERT_NE(cause, d.causes.end());
  EXPECT_NEAR(cause->parameters.front().value, kDifference, 0.1 * kDifference);
  EXPECT_LT(cause->evidence.holdout_rmse_ratio, 0.5);
}

}  // namespace
}  // namespace flexspline::studies
