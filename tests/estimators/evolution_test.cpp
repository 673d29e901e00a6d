// The search without derivatives: functions whose minimum is known.
#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "solvers/evolution.hpp"

namespace flexspline::estimators {
namespace {

template <class Cost>
CostsOf each(Cost cost) {
  return [cost](const Eigen::MatrixXd& candidates) {
    std::vector<double> list;
    for (Eigen::Index k = 0; k < candidates.cols(); ++k) list.push_back(cost(candidates.col(k)));
    return list;
  };
}

double valley(const Eigen::VectorXd& x) {
  return 100.0 * std::pow(x[1] - x[0] * x[0], 2) + std::pow(1.0 - x[0], 2);
}

std::vector<SearchedNumber> box(std::size_t n, double start, double lower, double upper) {
  return std::vector<SearchedNumber>(n, {start, lower, upper, 0.5});
}

TEST(Evolution, FollowsACurvedValleyToItsEnd) {
  const auto found = evolve(each(valley), box(2, -1.0, -5.0, 5.0), {.evaluations = 4000});
  EXPECT_NEAR(found.best[0], 1.0, 1e-3);
  EXPECT_NEAR(found.best[1], 1.0, 2e-3);
}

// Its derivative is zero wherever it exists.
TEST(Evolution, DescendsStairs) {
  const auto stairs = [](const Eigen::VectorXd& x) {
    double sum = 0.0;
    for (const double v : x) sum += std::floor(10.0 * std::abs(v - 0.3));
    return sum;
  };
  const auto found = evolve(each(stairs), box(6, 2.0, -4.0, 4.0), {.evaluations = 4000});
  EXPECT_EQ(found.cost, 0.0);
}

TEST(Evolution, EndsOnABoundWhereTheMinimumLiesBeyond) {
  const auto bowl = [](const Eigen::VectorXd& x) { return (x.array() - 3.0).square().sum(); };
  const auto found = evolve(each(bowl), box(3, 0.0, -1.0, 2.0), {.evaluations = 2000});
  EXPECT_NEAR(found.cost, 3.0, 1e-6);
}

TEST(Evolution, IsTheSameForASeedAndNeverWorseThanTheStart) {
  const auto cliff = [](const Eigen::VectorXd& x) {
    return x.isZero() ? 1.0 : std::numeric_limits<double>::infinity();
  };
  EXPECT_EQ(evolve(each(cliff), box(4, 0.0, -1.0, 1.0), {.evaluations = 100}).cost, 1.0);
  const EvolutionSettings how{.evaluations = 200, .seed = 7};
  const auto one = evolve(each(valley), box(2, -1.0, -5.0, 5.0), how);
  const auto again = evolve(each(valley), box(2, -1.0, -5.0, 5.0), how);
  EXPECT_EQ(one.best, again.best);
  EXPECT_NE(one.best, evolve(each(valley), box(2, -1.0, -5.0, 5.0), {200, 8}).best);
}

}  // namespace
}  // namespace flexspline::estimators
