// Covariances and what they are made of, against closed forms.
#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "uncertainty/covariance.hpp"
#include "uncertainty/identifiability.hpp"

namespace flexspline::estimators {
namespace {

// y_t = rho y_(t-1) + white noise.
std::vector<double> autoregressive(double rho, int count, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  std::vector<double> series;
  double y = 0.0;
  for (int i = 0; i < count; ++i) series.push_back(y = rho * y + normal(engine));
  return series;
}

double mean_ratio(double rho) {
  double sum = 0.0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    sum += long_run_ratio(autoregressive(rho, 4000, seed)) / 20.0;
  }
  return sum;
}

// (1 + rho)/(1 - rho) for a first-order process; a window of lags falls short of it.
TEST(LongRunRatio, OfAFirstOrderProcess) {
  EXPECT_NEAR(mean_ratio(0.0), 1.0, 0.05);
  EXPECT_NEAR(mean_ratio(0.5), 3.0, 0.4);
  EXPECT_NEAR(mean_ratio(0.8), 9.0, 1.8);
  EXPECT_NEAR(mean_ratio(-0.5), 1.0 / 3.0, 0.1);
}

TEST(LongRunRatio, OfNothingIsOne) {
  EXPECT_EQ(long_run_ratio(std::vector<double>(50, 0.0)), 1.0);
  EXPECT_EQ(long_run_ratio({}), 1.0);
}

Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index columns) {
  std::mt19937_64 engine(11);
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(engine); });
}

TEST(Sandwich, IsThatOfOrdinaryLeastSquaresUnderEqualNoise) {
  Eigen::MatrixXd j = random_matrix(60, 4);
  j.col(2) *= 1e6;  // units must not matter
  const Eigen::MatrixXd normal = j.transpose() * j;
  const Eigen::MatrixXd covariance = sandwich(j, 0.09 * normal, {false, false, false, false});
  const Eigen::MatrixXd expected = 0.09 * normal.inverse();
  for (Eigen::Index r = 0; r < 4; ++r) {
    for (Eigen::Index c = 0; c < 4; ++c) {
      const double size = std::sqrt(expected(r, r) * expected(c, c));
      EXPECT_NEAR(covariance(r, c) / size, expected(r, c) / size, 1e-9);
    }
  }
}

TEST(Sandwich, LeavesOutWhatIsOnABound) {
  const Eigen::MatrixXd j = random_matrix(60, 3);
  const Eigen::MatrixXd covariance = sandwich(j, j.transpose() * j, {false, true, false});
  EXPECT_EQ(covariance.row(1).norm(), 0.0);
  EXPECT_EQ(covariance.col(1).norm(), 0.0);
  Eigen::MatrixXd rest(60, 2);
  rest << j.col(0), j.col(2);
  const Eigen::MatrixXd expected = (rest.transpose() * rest).inverse();
  EXPECT_NEAR(covariance(0, 2), expected(0, 1), 1e-12);
  EXPECT_EQ(sandwich(j, j.transpose() * j, {true, true, true}).norm(), 0.0);
}

TEST(Sandwich, GrowsWithoutBoundAlongADirectionWithoutInformation) {
  Eigen::MatrixXd j = random_matrix(60, 3);
  j.col(2) = j.col(1);
  const Eigen::MatrixXd covariance = sandwich(j, j.transpose() * j, {false, false, false});
  EXPECT_GT(covariance(1, 1), 1e6);
  EXPECT_NEAR(covariance(0, 0), 1.0 / 60.0, 0.02);
}

TEST(StandardDeviation, IsThatOfALinearCombination) {
  Eigen::MatrixXd covariance(2, 2);
  covariance << 4.0, 1.0, 1.0, 9.0;
  EXPECT_NEAR(standard_deviation(covariance, std::vector{1.0, -2.0}), std::sqrt(4.0 - 4.0 + 36.0),
              1e-14);
}

TEST(LargestCosine, IsThatOfTheAngleBetweenPlanes) {
  for (double angle : {0.1, 0.7, 1.5}) {
    Eigen::MatrixXd of = Eigen::MatrixXd::Zero(5, 2);
    Eigen::MatrixXd rest = Eigen::MatrixXd::Zero(5, 2);
    rest(0, 0) = 3.0;
    rest(1, 1) = 1e-3;
    of(0, 0) = std::cos(angle);
    of(2, 0) = std::sin(angle);
    of(3, 1) = 100.0;
    EXPECT_NEAR(largest_cosine(of, rest), std::cos(angle), 1e-12);
    EXPECT_NEAR(largest_cosine(rest, of), std::cos(angle), 1e-12);
  }
}

TEST(LargestCosine, IsOneWhereSomethingCanBeImitated) {
  const Eigen::MatrixXd rest = random_matrix(40, 4);
  Eigen::MatrixXd of = random_matrix(40, 6).rightCols(2);
  EXPECT_LT(largest_cosine(of, rest), 0.9);
  of.col(1) = rest * Eigen::Vector4d(1.0, -2.0, 0.5, 3.0);
  EXPECT_NEAR(largest_cosine(of, rest), 1.0, 1e-12);
  EXPECT_EQ(largest_cosine(Eigen::MatrixXd::Zero(40, 2), rest), 0.0);
}

// Two unit columns at an angle: singular values sqrt(1 +- cos).
TEST(ScaledCondition, OfTwoColumnsAtAnAngle) {
  for (double angle : {0.01, 0.5, 1.2}) {
    Eigen::MatrixXd j = Eigen::MatrixXd::Zero(6, 3);
    j(0, 0) = 1e5;
    j(0, 1) = 1e-4 * std::cos(angle);
    j(4, 1) = 1e-4 * std::sin(angle);
    const double c = std::cos(angle);
    EXPECT_TRUE(std::isinf(scaled_condition(Eigen::MatrixXd::Zero(6, 2))));
    EXPECT_NEAR(scaled_condition(j) / std::sqrt((1.0 + c) / (1.0 - c)), 1.0, 1e-9);
  }
}

TEST(ScaledCondition, OfFewerRowsThanColumnsIsInfinite) {
  EXPECT_DOUBLE_EQ(scaled_condition(Eigen::MatrixXd::Identity(2, 3)), 1.0)
      << "a column of zeros is left out";
  EXPECT_TRUE(std::isinf(scaled_condition(Eigen::MatrixXd::Ones(2, 3))));
}

}  // namespace
}  // namespace flexspline::estimators
