// Draws from normal laws that are cut off, against closed forms.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "uncertainty/bounded_draws.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

BoundedNormal half_line(double mean, double sigma) {
  BoundedNormal law;
  law.mean = Eigen::VectorXd::Constant(1, mean);
  law.covariance = Eigen::MatrixXd::Constant(1, 1, sigma * sigma);
  law.lower = Eigen::VectorXd::Zero(1);
  law.upper = Eigen::VectorXd::Constant(1, kInfinity);
  return law;
}

double percentile(Eigen::VectorXd values, double share) {
  std::ranges::sort(values);
  return values[static_cast<Eigen::Index>(share * static_cast<double>(values.size() - 1))];
}

// Cut at its mean a normal law is half normal: mean sqrt(2/pi) sigma, 97.5 % at 2.2414 sigma.
TEST(BoundedDraws, OfAHalfNormalLaw) {
  const Eigen::MatrixXd draws = draws_of(half_line(0.0, 3.0), Eigen::VectorXd::Zero(1), 20000, 1);
  EXPECT_GE(draws.minCoeff(), 0.0);
  EXPECT_NEAR(draws.mean(), 3.0 * std::sqrt(2.0 / std::numbers::pi), 0.05);
  EXPECT_NEAR(percentile(draws.col(0), 0.975), 3.0 * 2.2414, 0.12);
}

// Far out the tail is exponential: beyond z it falls by 1/z.
TEST(BoundedDraws, OfATailFarOut) {
  const Eigen::MatrixXd draws = draws_of(half_line(-20.0, 1.0), Eigen::VectorXd::Zero(1), 20000, 1);
  EXPECT_GE(draws.minCoeff(), 0.0);
  EXPECT_NEAR(draws.mean(), 1.0 / 20.0, 0.002);
}

TEST(BoundedDraws, WithoutBoundsAreNormal) {
  BoundedNormal law;
  law.mean = Eigen::Vector2d(1.0, -2.0);
  law.covariance.resize(2, 2);
  law.covariance << 4.0, 1.2, 1.2, 0.49;
  law.lower = Eigen::VectorXd::Constant(2, -kInfinity);
  law.upper = Eigen::VectorXd::Constant(2, kInfinity);
  const Eigen::MatrixXd draws = draws_of(law, law.mean, 40000, 7);
  const Eigen::MatrixXd about = draws.rowwise() - law.mean.transpose();
  const Eigen::MatrixXd covariance = about.transpose() * about / 40000.0;
  EXPECT_TRUE(covariance.isApprox(law.covariance, 0.05)) << covariance;
}

TEST(BoundedDraws, OfAParameterWithoutAVarianceStayAtItsStart) {
  BoundedNormal law;
  law.mean = Eigen::Vector2d(0.0, 5.0);
  law.covariance = Eigen::Vector2d(9.0, 0.0).asDiagonal();
  law.lower = Eigen::Vector2d::Zero();
  law.upper = Eigen::VectorXd::Constant(2, kInfinity);
  const Eigen::MatrixXd draws = draws_of(law, Eigen::Vector2d(0.0, 2.0), 20000, 1);
  EXPECT_TRUE((draws.col(1).array() == 2.0).all());
  EXPECT_EQ(draws.col(0), draws_of(half_line(0.0, 3.0), Eigen::VectorXd::Zero(1), 20000, 1).col(0));
}

TEST(BoundedDraws, OfNoLawAreNone) {
  BoundedNormal law = half_line(0.0, 1.0);
  law.mean = law.lower = Eigen::Vector2d::Zero();
  law.upper = Eigen::VectorXd::Constant(2, kInfinity);
  law.covariance.resize(2, 2);
  law.covariance << 1.0, 2.0, 2.0, 1.0;
  EXPECT_EQ(draws_of(law, law.mean, 100, 1).size(), 0);
}

// Against draws of the whole law of which those outside are thrown away.
TEST(BoundedDraws, FollowTheirCorrelation) {
  BoundedNormal law;
  law.mean = Eigen::Vector2d(-0.5, 0.0);
  law.covariance.resize(2, 2);
  law.covariance << 1.0, -0.7, -0.7, 1.0;
  law.lower = Eigen::Vector2d(0.0, -kInfinity);
  law.upper = Eigen::VectorXd::Constant(2, kInfinity);
  const Eigen::MatrixXd draws = draws_of(law, Eigen::Vector2d(0.1, 0.0), 20000, 3);
  std::mt19937_64 engine(5);
  std::normal_distribution<double> normal;
  std::vector<double> second;
  while (second.size() < 20000) {
    const double a = normal(engine);
    const double b = -0.7 * a + std::sqrt(0.51) * normal(engine);
    if (a - 0.5 >= 0.0) second.push_back(b);
  }
  const Eigen::Map<const Eigen::VectorXd> kept(second.data(), 20000);
  EXPECT_NEAR(draws.col(1).mean(), kept.mean(), 0.03);
  for (double share : {0.025, 0.975}) {
    EXPECT_NEAR(percentile(draws.col(1), share), percentile(kept, share), 0.1);
  }
}

}  // namespace
}  // namespace flexspline::estimators
