// Frictions of a specimen whose sign is rounded off at speeds of their own, by laws that are not
// the fitted ones: what they are is named, and nothing beside it.
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnosis_checks.hpp"
#include "numbered_sine.hpp"

namespace flexspline::studies {
namespace {

constexpr double kNoise = 0.05;         // Nm
constexpr double kLargestRate = 0.176;  // rad/s

/// A rate over its magnitude, rounded off below a width.
double soft_sign(double rate, double width) { return rate / std::hypot(rate, width); }

/// A sine of motion over a spring that hardens and a drag, with a friction of the rate.
Recording recording_of(double amplitude, double frequency, unsigned seed,
                       const std::function<double(double)>& friction) {
  Recording r = numbered_sine(amplitude, frequency, seed);
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, kNoise);
  std::normal_distribution<double> jitter(0.0, 1e-6);
  const double omega = 2.0 * std::numbers::pi * frequency;
  for (int i = 0; i < 1200; ++i) {
    const double t = i / (400.0 * frequency);
    const double x = amplitude * std::sin(omega * t);
    const double rate = amplitude * omega * std::cos(omega * t);
    r.time.push_back(t);
    r.channels[Quantity::torsion].push_back(x + jitter(random));
    r.channels[Quantity::torque].push_back(800.0 * x + 4e5 * x * x * x + 8.0 * rate +
                                           friction(rate) + noise(random));
  }
  return r;
}

RecordingSet specimen(const std::function<double(double)>& friction) {
  RecordingSet set;
  set.name = "specimen";
  set.rig = Rig::specimen;
  unsigned seed = 1;
  for (double amplitude : {0.008, 0.014, 0.02}) {
    for (double frequency : {0.02, 0.18, 1.4}) {
      set.recordings.push_back(recording_of(amplitude, frequency, seed++, friction));
    }
  }
  return set;
}

TEST(RoundedFriction, AStribeckFrictionLeavesNothing) {
  const double falls = 0.2 * kLargestRate;
  const Diagnosis d = diagnosed(specimen([&](double rate) {
    return 1.5 * soft_sign(rate, 0.1 * falls) / (1.0 + std::pow(rate / falls, 2));
  }));
  EXPECT_THAT(names(d), testing::ElementsAre("stribeck_friction")) << d.says;
  EXPECT_EQ(d.verdict, Verdict::explained) << d.says;
  EXPECT_LT(d.holdout.rmse_after, 1.15 * d.holdout.noise_floor);
}

// A drag that grows with the cube of the rate is not larger one way than the other.
TEST(RoundedFriction, OneWayMoreThanTheOtherBesideADragThatIsNot) {
  const double more = 1.0;
  const Diagnosis d = diagnosed(specimen([&](double rate) {
    const double sign = soft_sign(rate, 0.03 * kLargestRate);
    return 0.5 * more * sign * (1.0 + sign) + 5.0 * std::pow(rate / kLargestRate, 3);
  }));
  EXPECT_THAT(names(d), testing::ElementsAre("direction_asymmetry")) << d.says;
  EXPECT_EQ(d.verdict, Verdict::explained) << d.says;
  EXPECT_LT(d.holdout.rmse_after, 1.15 * d.holdout.noise_floor);
  EXPECT_NEAR(d.causes.front().parameters[1].value, 0.5 * more, 0.06 * more);
}

}  // namespace
}  // namespace flexspline::studies
