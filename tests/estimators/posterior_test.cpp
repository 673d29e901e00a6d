#include <functional>

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "gears.hpp"
#include "posterior/folded_record.hpp"
#include "posterior/mixed_model.hpp"
#include "posterior/rich_spline.hpp"

namespace flexspline::estimators {
namespace {

// y_i = c_i + e_i with e of unit variance and c of variance v: REML is v = mean y^2 - 1.
TEST(MixedModel, EstimatesAVarianceInClosedForm) {
  constexpr Eigen::Index kCount = 40;
  const Eigen::MatrixXd information = Eigen::MatrixXd::Identity(kCount, kCount);
  Eigen::VectorXd y(kCount);
  for (Eigen::Index k = 0; k < kCount; ++k) y[k] = 3.0 * std::sin(1.7 * static_cast<double>(k));
  std::vector<PriorGroup> groups{{.first = 0, .count = kCount}};
  const auto posterior = restricted_likelihood(information, y, groups, 200);
  const double variance = y.squaredNorm() / kCount - 1.0;
  EXPECT_NEAR(1.0 / groups[0].precision, variance, 0.03 * variance);
  const double shrunk = 1.0 / (1.0 + groups[0].precision);
  EXPECT_LT((posterior.mean - shrunk * y).norm(), 1e-9 * y.norm());
  EXPECT_NEAR(posterior.covariance(3, 3), shrunk, 1e-9);
}

// A penalty on second differences leaves a straight line alone, however large it is.
TEST(MixedModel, LeavesAStraightLineAlone) {
  constexpr Eigen::Index kCount = 20;
  const Eigen::MatrixXd information = 100.0 * Eigen::MatrixXd::Identity(kCount, kCount);
  Eigen::VectorXd line(kCount);
  for (Eigen::Index k = 0; k < kCount; ++k) line[k] = 2.0 - 0.3 * static_cast<double>(k);
  const std::vector<std::array<double, 3>> rows(kCount - 2, {1.0, -2.0, 1.0});
  const auto posterior =
      posterior_of(information, 100.0 * line,
                   {{.first = 0, .count = kCount - 2, .rows = rows, .precision = 1e5}});
  EXPECT_LT((posterior.mean - line).cwiseAbs().maxCoeff(), 1e-7);
  EXPECT_LT(posterior.covariance(10, 10), 0.1 * 0.01);
}

// y_i = c_i + e_i again, with l = 1/v: V = 1/(1 + l), dc/d ln l = -l V c, and the information on ln
// v is n/2 (v/(v + 1))^2, beside 0.3/2 of the prior.
TEST(MixedModel, CountsThatThePrecisionIsEstimated) {
  constexpr Eigen::Index kCount = 12;
  constexpr double kPrecision = 0.4;
  const Eigen::MatrixXd information = Eigen::MatrixXd::Identity(kCount, kCount);
  const Eigen::VectorXd y = Eigen::VectorXd::LinSpaced(kCount, -2.0, 5.0);
  const std::vector<PriorGroup> groups{{.first = 0, .count = kCount, .precision = kPrecision}};
  const auto posterior = posterior_of(information, y, groups);
  const Eigen::MatrixXd all = unconditional_covariance(posterior, groups);
  const double known = 1.0 / (1.0 + kPrecision);
  const Eigen::VectorXd move = -kPrecision * known * known * y;
  const double told = 0.5 * kCount * known * known + 0.15;
  const Eigen::MatrixXd expected =
      known * Eigen::MatrixXd::Identity(kCount, kCount) + move * move.transpose() / told;
  EXPECT_LT((all - expected).norm(), 1e-9 * expected.norm());
}

TEST(RichSplineTest, BendsNowhereOnAStraightLine) {
  const RichSpline even(-1.0, 1.0, 20, 0.0);
  for (Eigen::Index k = 0; k < even.size() - 2; ++k) {
    const auto row = even.bend(k);
    EXPECT_NEAR(row[0], 1.0, 1e-9);
    EXPECT_NEAR(row[1], -2.0, 1e-9);
    EXPECT_NEAR(row[2], 1.0, 1e-9);
  }
  // A line that least squares puts into a spline finer about zero has no second difference to speak
  // of beside that of a kink with the same slopes.
  const RichSpline fine(-1.0, 1.0, 60, 0.02);
  const auto bends_of = [&](const std::function<double(double)>& f) {
    constexpr int kPoints = 4000;
    Eigen::MatrixXd rows(kPoints, fine.size());
    Eigen::VectorXd values(kPoints);
    for (int i = 0; i < kPoints; ++i) {
      const double x = 2.0 * i / (kPoints - 1) - 1.0;
      Eigen::RowVectorXd row(fine.size());
      fine.value(x, row);
      rows.row(i) = row;
      values[i] = f(x) - f(0.0);
    }
    const Eigen::VectorXd c = rows.completeOrthogonalDecomposition().solve(values);
    double largest = 0.0;
    for (Eigen::Index k = 0; k < fine.size() - 2; ++k) {
      const auto row = fine.bend(k);
      largest = std::max(largest, std::abs(row[0] * c[k] + row[1] * c[k + 1] + row[2] * c[k + 2]));
    }
    return largest;
  };
  EXPECT_LT(bends_of([](double x) { return x; }),
            0.02 * bends_of([](double x) { return std::abs(x); }));
}

TEST(RichSplineTest, IsZeroAtZeroAndKnowsItsSlope) {
  for (double fine : {0.0, 0.02}) {
    const RichSpline spline(-0.8, 1.3, 40, fine);
    Eigen::VectorXd c(spline.size());
    for (Eigen::Index k = 0; k < c.size(); ++k) c[k] = std::cos(0.3 * static_cast<double>(k));
    Eigen::RowVectorXd row(spline.size());
    const auto value = [&](double x) {
      spline.value(x, row);
      return row.dot(c);
    };
    EXPECT_NEAR(value(0.0), 0.0, 1e-14);
    for (double x : {-1.0, -0.51, -0.003, 0.011, 0.4, 1.29}) {
      constexpr double kStep = 1e-6;
      const double difference = (value(x + kStep) - value(x - kStep)) / (2.0 * kStep);
      spline.slope(x, row);
      EXPECT_NEAR(row.dot(c), difference, 1e-5 * (1.0 + std::abs(difference))) << x << " " << fine;
    }
    EXPECT_EQ(spline.beyond(1.0), 0.0);
    EXPECT_GT(spline.beyond(1.4), 0.0);
  }
}

// Four cycles of a sine: the noise of their mean is half that of a sample, told by the repeats
// alone.
TEST(FoldedRecordTest, TellsTheNoiseFromTheRepeats) {
  const auto prepared = prepare(
      {measured(gear_with_even_h(), {.cycles = 4, .per_cycle = 300, .noise = 0.01, .seed = 5})},
      3000);
  ASSERT_TRUE(prepared) << prepared.error().message();
  const FoldedRecord record = folded(prepared->front());
  ASSERT_TRUE(record.repeats);
  EXPECT_NEAR(record.noise.sigma, 0.5 * 0.01 * kPeak, 0.05 * 0.5 * 0.01 * kPeak);
  EXPECT_EQ(record.noise.share, 0.0);
  ASSERT_EQ(record.motion.size(), 2U);  // a constant and the sine
  for (std::size_t k = 0; k < record.time.size(); ++k) {
    const double angle = 2.0 * std::numbers::pi * kFrequency * record.time[k];
    EXPECT_NEAR(record.position[k], kAmplitude * std::sin(angle), 1e-4 * kAmplitude);
    EXPECT_NEAR(record.velocity[k], kSpeed * std::cos(angle), 1e-3 * kSpeed);
  }
}

}  // namespace
}  // namespace flexspline::estimators
