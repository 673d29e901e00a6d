// Intervals by profile likelihood and by bootstrap, against closed forms.
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Dense>
#include <boost/math/distributions/students_t.hpp>

#include "uncertainty/bootstrap.hpp"
#include "uncertainty/profile.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// One block of residuals given as functions of p.
class Curve final : public LeastSquaresProblem {
 public:
  using Row = std::function<double(std::span<const double>, std::span<double>)>;
  explicit Curve(std::vector<Row> rows) : rows_(std::move(rows)) {}
  std::size_t blocks() const override { return 1; }
  std::size_t residuals(std::size_t) const override { return rows_.size(); }
  Result<void> evaluate(std::size_t, std::span<const double> p, std::span<double> residual,
                        std::span<double> jacobian) const override {
    std::vector<double> slope(p.size());
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      residual[r] = rows_[r](p, slope);
      for (std::size_t k = 0; !jacobian.empty() && k < p.size(); ++k) {
        jacobian[r * p.size() + k] = slope[k];
      }
    }
    return {};
  }

 private:
  std::vector<Row> rows_;
};

Curve linear(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  std::vector<Curve::Row> rows;
  for (Eigen::Index r = 0; r < a.rows(); ++r) {
    const Eigen::VectorXd row = a.row(r);
    rows.push_back([row, y = b[r]](std::span<const double> p, std::span<double> slope) {
      double value = -y;
      for (std::size_t k = 0; k < p.size(); ++k) {
        slope[k] = row[static_cast<Eigen::Index>(k)];
        value += slope[k] * p[k];
      }
      return value;
    });
  }
  return Curve(std::move(rows));
}

std::vector<BoundedParameter> unbounded(std::size_t count) {
  return std::vector<BoundedParameter>(count, {0.0, -kInfinity, kInfinity, 1.0});
}

struct LinearCase {
  Eigen::MatrixXd a;
  Eigen::VectorXd b;
  Eigen::VectorXd best;
  Eigen::MatrixXd covariance;
  double variance;
  double freedom;
};

LinearCase line_through_noise(int count, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  LinearCase c{Eigen::MatrixXd(count, 2), Eigen::VectorXd(count), {}, {}, 0.0, count - 2.0};
  for (int k = 0; k < count; ++k) {
    c.a.row(k) << 1.0, 0.1 * k;
    c.b[k] = 2.0 - 0.3 * 0.1 * k + 0.2 * normal(engine);
  }
  c.best = c.a.colPivHouseholderQr().solve(c.b);
  c.variance = (c.a * c.best - c.b).squaredNorm() / c.freedom;
  c.covariance = c.variance * (c.a.transpose() * c.a).inverse();
  return c;
}

TEST(Profile, OfALinearModelIsStudentsInterval) {
  const auto c = line_through_noise(12, 3);
  const double t = boost::math::quantile(boost::math::students_t(c.freedom), 0.975);
  const std::vector<double> best(c.best.begin(), c.best.end());
  for (std::size_t k = 0; k < 2; ++k) {
    const auto interval = profile_interval(linear(c.a, c.b), unbounded(2), best, c.covariance, k,
                                           {.variance = c.variance, .quantile = t});
    ASSERT_TRUE(interval) << interval.error().message();
    const auto i = static_cast<Eigen::Index>(k);
    const double half = t * std::sqrt(c.covariance(i, i));
    EXPECT_NEAR(interval->lower, best[k] - half, 1e-6 * half);
    EXPECT_NEAR(interval->upper, best[k] + half, 1e-6 * half);
    EXPECT_FALSE(interval->lower_open || interval->upper_open);
  }
}

// One residual exp(p) - y of variance v: the cost is half of it squared, so the interval of p is
// ln(y -+ q sqrt(v)), and without a lower end once y < q sqrt(v).
TEST(Profile, OfAnExponentialIsThatOfItsLogarithm) {
  for (double y : {3.0, 1.0}) {
    const Curve curve({[y](std::span<const double> p, std::span<double> slope) {
      slope[0] = std::exp(p[0]);
      return std::exp(p[0]) - y;
    }});
    const Eigen::MatrixXd covariance = Eigen::MatrixXd::Constant(1, 1, 1.0 / (y * y));
    const auto interval = profile_interval(curve, unbounded(1), std::vector{std::log(y)},
                                           covariance, 0, {.variance = 1.0, .quantile = 1.96});
    ASSERT_TRUE(interval) << interval.error().message();
    EXPECT_NEAR(interval->upper, std::log(y + 1.96), 1e-6);
    EXPECT_EQ(interval->lower_open, y < 1.96);
    if (interval->lower_open) {
      EXPECT_EQ(interval->lower, -kInfinity);
    } else {
      EXPECT_NEAR(interval->lower, std::log(y - 1.96), 1e-6);
    }
  }
}

// r = (a b - 2, 0.1 (b - 1)): held at a, the best b is a line's, and twice the cost is
// (a - 2)^2 / (1 + 100 a^2); it never exceeds 0.01 for large a.
TEST(Profile, LetsTheOtherParametersFollow) {
  const Curve curve({[](std::span<const double> p, std::span<double> slope) {
                       slope[0] = p[1];
                       slope[1] = p[0];
                       return p[0] * p[1] - 2.0;
                     },
                     [](std::span<const double> p, std::span<double> slope) {
                       slope[0] = 0.0;
                       slope[1] = 0.1;
                       return 0.1 * (p[1] - 1.0);
                     }});
  Eigen::MatrixXd j(2, 2);
  j << 1.0, 2.0, 0.0, 0.1;
  const Eigen::MatrixXd covariance = (j.transpose() * j).inverse();
  const double quantile = 0.08;
  const auto interval = profile_interval(curve, unbounded(2), std::vector{2.0, 1.0}, covariance, 0,
                                         {.variance = 1.0, .quantile = quantile});
  ASSERT_TRUE(interval) << interval.error().message();
  for (double a : {interval->lower, interval->upper}) {
    EXPECT_NEAR(std::abs(a - 2.0) / std::sqrt(1.0 + 100.0 * a * a), quantile, 1e-6);
  }
  const auto wide = profile_interval(curve, unbounded(2), std::vector{2.0, 1.0}, covariance, 0,
                                     {.variance = 1.0, .quantile = 0.2});
  ASSERT_TRUE(wide) << wide.error().message();
  EXPECT_TRUE(wide->upper_open);
}

TEST(Profile, EndsAtABound) {
  const auto c = line_through_noise(12, 3);
  auto parameters = unbounded(2);
  parameters[1].upper = c.best[1] + 0.1 * std::sqrt(c.covariance(1, 1));
  const auto interval = profile_interval(linear(c.a, c.b), parameters,
                                         std::vector<double>(c.best.begin(), c.best.end()),
                                         c.covariance, 1, {.variance = c.variance});
  ASSERT_TRUE(interval) << interval.error().message();
  EXPECT_TRUE(interval->upper_open);
  EXPECT_EQ(interval->upper, parameters[1].upper);
  EXPECT_FALSE(interval->lower_open);
}

TEST(Profile, SaysWhenTheFitIsNotTheMinimum) {
  const auto c = line_through_noise(12, 3);
  const auto interval =
      profile_interval(linear(c.a, c.b), unbounded(2), std::vector{c.best[0] + 1.0, c.best[1]},
                       c.covariance, 0, {.variance = c.variance});
  ASSERT_FALSE(interval);
  EXPECT_THAT(interval.error().message(), ::testing::HasSubstr("not the minimum"));
}

TEST(Bootstrap, ParametricHasTheVarianceOfALinearModel) {
  const auto c = line_through_noise(40, 5);
  const auto drawn =
      bootstrap(linear(c.a, c.b), unbounded(2), std::vector<double>(c.best.begin(), c.best.end()),
                {.replicates = 2000, .seed = 9});
  ASSERT_TRUE(drawn) << drawn.error().message();
  EXPECT_EQ(drawn->failed, 0u);
  for (Eigen::Index k = 0; k < 2; ++k) {
    // The relative error of a variance from 2000 draws has a standard deviation of 0.032.
    EXPECT_NEAR(drawn->covariance(k, k) / c.covariance(k, k), 1.0, 0.1);
    const double half = 1.96 * std::sqrt(c.covariance(k, k));
    const auto i = static_cast<std::size_t>(k);
    EXPECT_NEAR((drawn->upper[i] - drawn->lower[i]) / (2.0 * half), 1.0, 0.08);
  }
}

TEST(Bootstrap, RepeatsItselfWithASeedAndGrowsByMoreReplicates) {
  const auto c = line_through_noise(20, 5);
  const std::vector<double> best(c.best.begin(), c.best.end());
  for (auto resampling : {Resampling::parametric, Resampling::block}) {
    BootstrapSettings settings{.resampling = resampling, .replicates = 10, .seed = 4};
    const auto few = bootstrap(linear(c.a, c.b), unbounded(2), best, settings);
    settings.replicates = 20;
    const auto many = bootstrap(linear(c.a, c.b), unbounded(2), best, settings);
    settings.seed = 5;
    const auto other = bootstrap(linear(c.a, c.b), unbounded(2), best, settings);
    ASSERT_TRUE(few && many && other);
    EXPECT_EQ(few->replicate, many->replicate.topRows(10));
    EXPECT_NE(other->replicate, many->replicate);
  }
}

struct Ratios {
  double block = 0.0;
  double parametric = 0.0;
};

// Variance of the mean of y_t = rho y_(t-1) + white noise, over that of the process:
// sigma^2/n (1 + rho)/(1 - rho) for many samples.
Ratios mean_of_coloured_noise(double rho, int count) {
  Ratios ratio;
  constexpr int kSeries = 12;
  const double analytic = 1.0 / std::pow(1.0 - rho, 2) / count;
  for (unsigned seed = 1; seed <= kSeries; ++seed) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> normal;
    Eigen::VectorXd y(count);
    double state = normal(engine) / std::sqrt(1.0 - rho * rho);
    for (double& value : y) value = state = rho * state + normal(engine);
    const auto curve = linear(Eigen::MatrixXd::Ones(count, 1), y);
    BootstrapSettings settings{.resampling = Resampling::block, .replicates = 150, .seed = seed};
    const auto block = bootstrap(curve, unbounded(1), std::vector{y.mean()}, settings);
    settings.resampling = Resampling::parametric;
    const auto white = bootstrap(curve, unbounded(1), std::vector{y.mean()}, settings);
    EXPECT_TRUE(block && white);
    ratio.block += block->covariance(0, 0) / analytic / kSeries;
    ratio.parametric += white->covariance(0, 0) / analytic / kSeries;
  }
  return ratio;
}

TEST(Bootstrap, InBlocksHasTheVarianceThatColouredNoiseLeaves) {
  const auto coloured = mean_of_coloured_noise(0.6, 1000);
  EXPECT_NEAR(coloured.block, 1.0, 0.2);
  // Noise taken as white misses the factor (1 + rho)/(1 - rho) = 4.
  EXPECT_NEAR(coloured.parametric, 0.25, 0.05);
  EXPECT_NEAR(mean_of_coloured_noise(0.0, 1000).block, 1.0, 0.15);
}

TEST(StationaryBlockLength, OfAFirstOrderProcess) {
  std::mt19937_64 engine(2);
  std::normal_distribution<double> normal;
  std::vector<double> series;
  double state = 0.0;
  for (int i = 0; i < 8000; ++i) series.push_back(state = 0.5 * state + normal(engine));
  EXPECT_NEAR(stationary_block_length(series), std::pow(1.0 / 0.75, 2.0 / 3.0) * 20.0, 2.0);
  EXPECT_EQ(stationary_block_length({}), 1.0);
}

}  // namespace
}  // namespace flexspline::estimators
