// Static regression: exact on laws of its class, of fourth order in its intervals, and open about
// what the recordings do not carry.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gears.hpp"

namespace flexspline::estimators {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string refusal(const Result<Estimate>& estimate) {
  return estimate ? std::string() : estimate.error().message();
}

Options intervals(double count) { return {.numbers = {{"intervals", count}}, .words = {}}; }

/// Cubic on each side of zero: in the class of every number of intervals.
Gear cubic_gear() {
  return {.f =
              [](double phi) {
                const double x = phi / kAmplitude;
                return (4.81 + 11.77 * x * x) * x;
              },
          .g_inverse =
              [](double speed) {
                const double z = speed / kSpeed;
                return (1.0 + 3.0 * std::abs(z) + 2.0 * z * z) * z;
              }};
}

TEST(StaticRegression, IsExactOnALawOfItsClass) {
  const Gear gear = cubic_gear();
  for (double count : {1.0, 3.0, 6.0}) {
    const auto estimate =
        fitted("static_regression", four_loops(gear, {.per_cycle = 2000}), intervals(count));
    ASSERT_TRUE(estimate) << estimate.error().message();
    EXPECT_EQ(estimate->estimator, "static_regression");
    EXPECT_LT(worst_error(estimate->model.f, gear.f, kAmplitude), 1e-5) << count;
    EXPECT_LT(worst_error(estimate->model.g_inverse, gear.g_inverse, kSpeed), 1e-5) << count;
  }
}

TEST(StaticRegression, FindsAnHAndADelayOfItsClass) {
  const LawSpec spec{
      .law = "bounded_modulation", .scale = kAmplitude, .knots = {}, .coefficients = {0.1, 0.3}};
  const auto h = make_law(spec);
  ASSERT_TRUE(h);
  Gear gear = cubic_gear();
  gear.h = [&](double phi) { return (*h)->value(phi); };
  gear.delay = 0.5;
  const auto estimate =
      fitted("static_regression", four_loops(gear, {.per_cycle = 2000}), intervals(2));
  ASSERT_TRUE(estimate) << estimate.error().message();
  EXPECT_LT(worst_error(estimate->model.h, gear.h, kAmplitude), 1e-4);
  EXPECT_LT(worst_error(estimate->model.g_inverse, gear.g_inverse, kSpeed), 1e-4);
  const auto delay = std::ranges::find(estimate->parameters, "delay", &ParameterEstimate::name);
  ASSERT_NE(delay, estimate->parameters.end());
  EXPECT_NEAR(delay->value, gear.delay, 1e-3);
}

// Cubic splines: the error of a smooth law falls with the fourth power of the interval.
TEST(StaticRegression, ConvergesWithTheFourthOrderInItsIntervals) {
  Gear gear = cubic_gear();
  gear.f = [](double phi) { return 10.0 * std::sinh(2.0 * phi / kAmplitude) / std::sinh(2.0); };
  std::vector<double> errors;
  for (double count : {3.0, 6.0, 12.0}) {
    Options options = intervals(count);
    options.words = {{"h", "unity"}, {"inertia", "off"}, {"delay", "off"}};
    const auto estimate =
        fitted("static_regression", four_loops(gear, {.per_cycle = 250}), options);
    ASSERT_TRUE(estimate) << estimate.error().message();
    errors.push_back(rms_error(estimate->model.f, gear.f, kAmplitude));
  }
  EXPECT_GT(std::log2(errors[0] / errors[1]), 3.5) << errors[0] << " " << errors[1];
  EXPECT_GT(std::log2(errors[1] / errors[2]), 3.5) << errors[1] << " " << errors[2];
}

TEST(StaticRegression, NamesTheRecordingThatHWouldNeed) {
  const Gear gear = gear_with_even_h();
  const auto one = measured(gear, {.noise = 0.002});
  const auto alone = fitted("static_regression", {one});
  ASSERT_TRUE(alone) << alone.error().message();
  EXPECT_EQ(alone->identifiability.verdict, "not_identifiable");
  EXPECT_THAT(alone->identifiability.says,
              AllOf(HasSubstr("Missing: a loop of half the amplitude (0.1 deg at 0.005 Hz)"),
                    HasSubstr("a loop at half the frequency (0.2 deg at 0.0025 Hz)")));
  for (const Loop& named : {Loop{.amplitude = 0.5, .noise = 0.002, .seed = 2},
                            Loop{.frequency = 0.5, .noise = 0.002, .seed = 3}}) {
    const auto both = fitted("static_regression", {one, measured(gear, named)});
    ASSERT_TRUE(both) << both.error().message();
    EXPECT_EQ(both->identifiability.verdict, "identifiable") << both->identifiability.says;
  }
}

TEST(StaticRegression, NamesTheRecordingThatAnInertiaWouldNeed) {
  Gear gear = smooth_gear();
  const double omega = 2.0 * std::numbers::pi * kFrequency;
  gear.inertia = 0.8 / (kAmplitude * omega * omega);
  const auto one = measured(gear, {.noise = 0.002});
  const auto alone = fitted("static_regression", {one});
  ASSERT_TRUE(alone) << alone.error().message();
  EXPECT_THAT(alone->notes,
              testing::Contains(AllOf(HasSubstr("inertia is not fitted"),
                                      HasSubstr("Missing: a loop at half the frequency (0.2 deg "
                                                "at 0.0025 Hz)"))));
  const auto both = fitted("static_regression",
                           {one, measured(gear, {.frequency = 0.5, .noise = 0.002, .seed = 3})});
  ASSERT_TRUE(both) << both.error().message();
  const auto inertia = std::ranges::find(both->parameters, "inertia", &ParameterEstimate::name);
  ASSERT_NE(inertia, both->parameters.end());
  EXPECT_NEAR(inertia->value / gear.inertia, 1.0, 0.05);
}

// A torque against the acceleration is no inertia, however well one below zero would fit it.
TEST(StaticRegression, AnInertiaBelowZeroIsLeftOut) {
  Gear gear = smooth_gear();
  const double omega = 2.0 * std::numbers::pi * kFrequency;
  gear.inertia = -0.8 / (kAmplitude * omega * omega);
  const std::vector<TorsionRecord> two = {
      measured(gear, {.noise = 0.002}),
      measured(gear, {.frequency = 0.5, .noise = 0.002, .seed = 3})};
  for (const char* method : {"static_regression", "trajectory_ceres"}) {
    const auto fit = fitted(method, two);
    ASSERT_TRUE(fit) << fit.error().message();
    EXPECT_EQ(std::ranges::find(fit->parameters, "inertia", &ParameterEstimate::name),
              fit->parameters.end());
    EXPECT_THAT(fit->notes,
                testing::Contains(AllOf(HasSubstr("inertia is left out: it comes out as -"),
                                        HasSubstr("none is below zero"))));
  }
}

TEST(StaticRegression, RefusesAMotionOneWay) {
  const Gear gear = cubic_gear();
  TorsionRecord ramp;
  ramp.id = "ramp";
  for (int i = 0; i <= 400; ++i) {
    const double u = i / 400.0;
    const double speed = kSpeed * (0.5 + u);
    ramp.time.push_back(u * 100.0);
    ramp.motion.push_back(kAmplitude * (u + u * u) * 0.5);
    ramp.effort.push_back(gear.f(ramp.motion.back()) + gear.g_inverse(speed));
  }
  ramp.valid.assign(ramp.time.size(), true);
  for (const char* method : {"static_regression", "trajectory_ceres"}) {
    EXPECT_THAT(refusal(fitted(method, {ramp})),
                AllOf(HasSubstr("f and g^-1 cannot be told apart"),
                      HasSubstr("the way down is missing: record a whole loop")));
  }
}

TEST(StaticRegression, RefusesFewerSamplesThanUnknowns) {
  EXPECT_THAT(
      refusal(fitted("static_regression", {measured(cubic_gear(), {.cycles = 3, .per_cycle = 12})},
                     intervals(60))),
      AllOf(HasSubstr("unknowns"), HasSubstr("record longer")));
}

}  // namespace
}  // namespace flexspline::estimators
