// Intervals of the torsion law's parameters by profile likelihood and by bootstrap.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "torsion_intervals.hpp"

namespace flexspline::estimators {
namespace {

using testing::Contains;
using testing::HasSubstr;

// The residuals of eq. (4) are linear in f and g^-1: away from bounds the profile is the interval
// of the covariance. It is cut where a coefficient's floor is nearer than that.
TEST(TorsionIntervals, ByProfileAreThoseOfTheCovarianceWhereTheModelIsLinear) {
  const auto plain = with_intervals("covariance", "torque", 20);
  const auto profile = with_intervals("profile", "torque", 20);
  ASSERT_EQ(plain.parameters.size(), profile.parameters.size());
  int same = 0;
  for (std::size_t k = 0; k < plain.parameters.size(); ++k) {
    const auto& a = plain.parameters[k];
    const auto& b = profile.parameters[k];
    EXPECT_EQ(a.value, b.value);
    EXPECT_LE(b.ci95_lower, b.value + 1e-9 * std::abs(b.value)) << b.name;
    EXPECT_GE(b.ci95_upper, b.value - 1e-9 * std::abs(b.value)) << b.name;
    if (is_free(a)) same += std::abs(width(b) / width(a) - 1.0) < 0.02;
  }
  EXPECT_GE(same, 6);
}

TEST(TorsionIntervals, ByBootstrapHaveItsSpread) {
  for (const std::string kind : {"bootstrap_parametric", "bootstrap_block"}) {
    const auto plain = with_intervals("covariance", "torque", 20);
    const auto drawn = with_intervals(kind, "torque", 100);
    ASSERT_EQ(plain.parameters.size(), drawn.parameters.size());
    EXPECT_THAT(drawn.notes, Contains(HasSubstr("100 ")));
    double ratio = 0.0;
    int counted = 0;
    for (std::size_t k = 0; k < plain.parameters.size(); ++k) {
      const auto& a = plain.parameters[k];
      if (!is_free(a) || a.value < 4.0 * a.std) continue;
      ratio += drawn.parameters[k].std / a.std;
      ++counted;
    }
    ASSERT_GE(counted, 4);
    EXPECT_NEAR(ratio / counted, 1.0, 0.25) << kind;
  }
}

}  // namespace
}  // namespace flexspline::estimators
