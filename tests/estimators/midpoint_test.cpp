// The paper's fit: exact on its own truth, and wrong in the way that h makes it wrong.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gears.hpp"

namespace flexspline::estimators {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

std::string refusal(const Result<Estimate>& estimate) {
  return estimate ? std::string() : estimate.error().message();
}

TEST(Midpoint, FindsTableIOnItsOwnLoop) {
  const auto estimate = fitted("midpoint_polynomial", {measured(table_i(), {.per_cycle = 4000})});
  ASSERT_TRUE(estimate) << estimate.error().message();
  ASSERT_EQ(estimate->parameters.size(), 10U);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_NEAR(estimate->parameters[k].value / kTableF[k], 1.0, 1e-6) << "a" << k + 1;
    EXPECT_NEAR(estimate->parameters[5 + k].value / kTableG[k], 1.0, 1e-6) << "b" << k + 1;
  }
  EXPECT_EQ(estimate->parameters[2].name, "a3");
  EXPECT_EQ(estimate->parameters[2].unit, "Nm/deg^5");
  EXPECT_EQ(estimate->parameters[9].unit, "Nm/(deg/s)^9");
}

// f' = 0 at 118 % and (g^-1)' = 0 at 113.5 % of the range: roots of Table I's derivatives.
TEST(Midpoint, SaysWhereItsPolynomialsCeaseToIncrease) {
  const auto estimate = fitted("midpoint_polynomial", {measured(table_i(), {.per_cycle = 1000})});
  ASSERT_TRUE(estimate);
  EXPECT_THAT(estimate->notes, Contains(HasSubstr("f increases up to 118.")));
  EXPECT_THAT(estimate->notes, Contains(HasSubstr("g^-1 increases up to 113.")));
  EXPECT_EQ(estimate->identifiability.verdict, "not_identifiable");
}

// Eq. (17) holds for any h, eq. (16) does not: an even h leaves f right and goes into g^-1.
TEST(Midpoint, TakesAnEvenModulationForDamping) {
  const auto gear = gear_with_even_h();
  const auto estimate = fitted("midpoint_polynomial", {measured(gear, {.per_cycle = 1000})});
  ASSERT_TRUE(estimate);
  EXPECT_LT(worst_error(estimate->model.f, gear.f, kAmplitude), 1e-4);
  const double damping = rms_error(estimate->model.g_inverse, gear.g_inverse, kSpeed);
  EXPECT_GT(damping, 0.07);
  EXPECT_LT(damping, 0.10);
}

TEST(Midpoint, FitsTheWidestOfSeveralLoops) {
  const auto estimate = fitted("midpoint_polynomial", {measured(table_i(), {.amplitude = 0.5}),
                                                       measured(table_i(), {.amplitude = 1.0}),
                                                       measured(table_i(), {.amplitude = 0.7})});
  ASSERT_TRUE(estimate);
  ASSERT_EQ(estimate->fits.size(), 1U);
  EXPECT_THAT(estimate->fits.front().id, HasSubstr("a1.0"));
  EXPECT_THAT(estimate->notes, Contains(HasSubstr("widest loop")));
}

TEST(MidpointPooled, FitsAllLoopsAndNamesThoseItLeavesOut) {
  auto one = measured(table_i(), {.amplitude = 0.6});
  auto brief = measured(table_i(), {.cycles = 1});
  brief.id = "brief";
  const auto estimate = fitted("midpoint_pooled", {measured(table_i(), {}), one, brief});
  ASSERT_TRUE(estimate);
  EXPECT_EQ(estimate->fits.size(), 2U);
  EXPECT_LT(worst_error(estimate->model.f, table_i().f, kAmplitude), 1e-4);
  EXPECT_THAT(estimate->notes, Contains(HasSubstr("brief")));
}

TEST(Midpoint, RefusesWhatHasNoLoopOrIsNoSine) {
  auto growing = measured(table_i(), {});
  growing.id = "growing";
  for (std::size_t i = 0; i < growing.time.size(); ++i) {
    growing.motion[i] *= std::exp(growing.time[i] * kFrequency);
  }
  auto squarish = measured(table_i(), {.cycles = 8});
  squarish.id = "squarish";
  for (double& x : squarish.motion) {
    const double s = x / kAmplitude;
    x = kAmplitude * (s + 0.6 * (3.0 * s - 4.0 * s * s * s));  // sin a + 0.6 sin 3a
  }
  for (std::string_view method : {"midpoint_polynomial", "midpoint_pooled"}) {
    EXPECT_THAT(refusal(fitted(method, {growing})), HasSubstr("growing does not repeat")) << method;
    // 74 %: 1/(1 + 0.36) of the variance is the sine's.
    EXPECT_THAT(
        refusal(fitted(method, {squarish})),
        AllOf(HasSubstr("a sine explains 7"), HasSubstr("of the motion of recording squarish")));
  }
}

}  // namespace
}  // namespace flexspline::estimators
