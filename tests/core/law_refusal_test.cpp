#include <limits>

#include <gtest/gtest.h>

#include "flexspline/core/law.hpp"

namespace flexspline {
namespace {

TEST(MakeLaw, RefusesACoefficientThatIsNoNumber) {
  LawSpec spec{.law = "odd_polynomial", .scale = 1.0, .knots = {}, .coefficients = {1.0, 2.0}};
  ASSERT_TRUE(make_law(spec));
  spec.coefficients[1] = std::numeric_limits<double>::quiet_NaN();
  const auto law = make_law(spec);
  ASSERT_FALSE(law);
  EXPECT_NE(law.error().message().find("odd_polynomial"), std::string::npos);
}

}  // namespace
}  // namespace flexspline
