// The least value of a polynomial over [0, 1], and what limits on a torsion law promise with it.
#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "flexspline/estimators/polynomial_torsion.hpp"
#include "ode_fit/bernstein.hpp"

namespace flexspline::estimators {
namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::HasSubstr;

double value(const std::vector<double>& c, double s) {
  double sum = 0.0;
  for (std::size_t k = c.size(); k-- > 0;) sum = sum * s + c[k];
  return sum;
}

// (s - 0.3)^2 + 0.01 between points that a grid of a tenth would not tell from it.
TEST(Bernstein, FindsTheLeastOfAParabola) {
  const std::vector<double> c = {0.1, -0.6, 1.0};
  const auto least = least_on_unit(c, 1e-10);
  EXPECT_NEAR(least.value, 0.01, 1e-10);
  EXPECT_NEAR(least.at, 0.3, 1e-4);
}

TEST(Bernstein, EndsCount) {
  EXPECT_EQ(least_on_unit(std::vector{2.0, 1.0}, 1e-10).at, 0.0);
  EXPECT_EQ(least_on_unit(std::vector{2.0, -1.0}, 1e-10).value, 1.0);
  EXPECT_EQ(least_on_unit(std::vector{3.0}, 1e-10).value, 3.0);
}

TEST(Bernstein, NoPointOfAFineGridLiesBelow) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<double> c(2 + static_cast<std::size_t>(trial % 7));
    for (double& one : c) one = uniform(engine);
    const auto least = least_on_unit(c, 1e-9);
    EXPECT_NEAR(value(c, least.at), least.value, 1e-12);
    for (int k = 0; k <= 2000; ++k) EXPECT_GE(value(c, k / 2000.0), least.value - 1e-9);
  }
}

TEST(PolynomialTorsionLimits, SayWhetherTheyHoldBetweenTheirPoints) {
  const PolynomialTorsionLimits limits({.f = 3, .g = 1, .h = 1}, {.slope = 0.5, .points = 3});
  const std::vector<double> held = {1.0, 0.1, 0.0, 1.0, 0.2};
  EXPECT_THAT(limits.between(held), Each(HasSubstr("proved")));
  // At s = 0, 1/4 and 1 the slope is 1, 0.55 and 0.8; at s = 0.55 it is 0.36.
  const std::vector<double> dips = {1.0, -0.777778, 0.426667, 1.0, 0.2};
  const auto says = limits.between(dips);
  ASSERT_EQ(says.size(), 4U);
  EXPECT_THAT(says[0], AllOf(HasSubstr("f'"), HasSubstr("at the points alone")));
  EXPECT_THAT(says[1], HasSubstr("proved"));
}

}  // namespace
}  // namespace flexspline::estimators
