// What is left without a name as a table: functions that are known, noise alone, formulas.
#include <gtest/gtest.h>
#include <Eigen/Cholesky>

#include <random>

#include "diagnosis/unnamed/smooth_table.hpp"
#include "diagnosis/unnamed/table_form.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::VectorXd;

constexpr Index kRows = 4000;

ArrayXd drawn(std::uint64_t seed, Index rows = kRows) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  return ArrayXd::NullaryExpr(rows, [&] { return normal(engine); });
}

ArrayXd even(std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  return ArrayXd::NullaryExpr(kRows, [&] { return uniform(engine); });
}

SmoothTable table_over(const ArrayXd& x, int knots) {
  return SmoothTable({{x, quantile_knots(x, ArrayXd::Ones(x.size()), knots)}});
}

SmoothTable table_over(const ArrayXd& x, const ArrayXd& y, int knots) {
  const ArrayXd all = ArrayXd::Ones(x.size());
  return SmoothTable({{x, quantile_knots(x, all, knots)}, {y, quantile_knots(y, all, knots)}});
}

TEST(QuantileKnots, HoldEquallyManyRowsAndAreNeverTwice) {
  const ArrayXd x = ArrayXd::LinSpaced(101, 0.0, 1.0).square();
  const auto knots = quantile_knots(x, ArrayXd::Ones(101), 5);
  const std::vector<double> quarters = {0.0, 0.0625, 0.25, 0.5625, 1.0};
  ASSERT_EQ(knots.size(), quarters.size());
  for (std::size_t k = 0; k < knots.size(); ++k) EXPECT_NEAR(knots[k], quarters[k], 1e-12);
  EXPECT_EQ(quantile_knots(ArrayXd::Constant(50, 3.0), ArrayXd::Ones(50), 5).size(), 1U);
  EXPECT_TRUE(quantile_knots(x, ArrayXd::Zero(101), 5).empty()) << "no row has a weight";
}

// A function that is linear between the knots is its values there, as noise goes to zero.
TEST(SmoothTable, IsTheFunctionThatItCanBe) {
  const ArrayXd x = even(1), y = even(2);
  const SmoothTable table = table_over(x, y, 5);
  VectorXd truth = drawn(3, table.size()).matrix();
  const ArrayXd value = table.at_rows(truth);
  const auto fit = table.fit(value + 1e-5 * drawn(4), ArrayXd::Constant(kRows, 1e5), 1.0);
  EXPECT_LT((fit.u - truth).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_GT(fit.gain, 1e4);
}

TEST(SmoothTable, IsHeldBeyondItsKnots) {
  const ArrayXd x = ArrayXd::LinSpaced(7, -3.0, 3.0);
  const SmoothTable table({{x, {-1.0, 0.0, 1.0}}});
  const ArrayXd value = table.at_rows(VectorXd{{5.0, 0.0, 2.0}});
  const double expected[] = {5.0, 5.0, 5.0, 0.0, 2.0, 2.0, 2.0};
  for (Index r = 0; r < 7; ++r) EXPECT_DOUBLE_EQ(value[r], expected[r]);
}

// The evidence is the log density of a Gaussian, by the dense covariance of its rows.
TEST(SmoothTable, ItsGainIsAGaussianLogDensity) {
  constexpr Index kFew = 60;
  const ArrayXd x = even(5).head(kFew);
  const SmoothTable table = table_over(x, 4);
  const ArrayXd y = (3.0 * x).sin() + 0.3 * drawn(6, kFew);
  const auto fit = table.fit(y, ArrayXd::Ones(kFew), 1.0);
  Eigen::MatrixXd z(kFew, table.size());
  for (Index k = 0; k < table.size(); ++k)
    z.col(k) = table.at_rows(VectorXd::Unit(table.size(), k));
  const auto density = [&](double noise, double size) {
    const Eigen::MatrixXd c =
        noise * Eigen::MatrixXd::Identity(kFew, kFew) + size * z * z.transpose();
    const Eigen::LLT<Eigen::MatrixXd> llt(c);
    const double determinant = 2.0 * llt.matrixL().toDenseMatrix().diagonal().array().log().sum();
    return -0.5 * (determinant + y.matrix().dot(llt.solve(y.matrix())));
  };
  // At its best over both variances, found by a grid.
  double best = -1e300;
  for (double noise = 0.03; noise < 0.4; noise *= 1.02) {
    for (double size = 0.05; size < 20.0; size *= 1.05) best = std::max(best, density(noise, size));
  }
  const double none = -0.5 * static_cast<double>(kFew) * (std::log(y.square().mean()) + 1.0);
  EXPECT_NEAR(fit.gain, best - none, 2e-3);
}

TEST(SmoothTable, FindsNothingInNoise) {
  const ArrayXd x = even(7), y = even(8);
  const SmoothTable table = table_over(x, y, 6);
  for (std::uint64_t seed = 100; seed < 140; ++seed) {
    const auto fit = table.fit(drawn(seed), ArrayXd::Ones(kRows), 1.0);
    EXPECT_LT(fit.gain, 6.0) << seed;
    EXPECT_LT(table.at_rows(fit.u).square().mean(), 0.02) << seed;
  }
}

TEST(SmoothTable, CountsRowsOverTheColour) {
  const ArrayXd x = even(9);
  const SmoothTable table = table_over(x, 6);
  const ArrayXd y = 0.2 * x + drawn(10);
  const double plain = table.fit(y, ArrayXd::Ones(kRows), 1.0).gain;
  const double coloured = table.fit(y, ArrayXd::Ones(kRows), 10.0).gain;
  EXPECT_GT(plain, 5.0 * coloured) << "a tenth of the rows know a tenth";
}

std::vector<double> spaced(double from, double to, int count) {
  std::vector<double> values;
  for (int k = 0; k < count; ++k) values.push_back(from + (to - from) * k / (count - 1));
  return values;
}

std::string form_over(const TableAxis& a, const TableAxis& b,
                      const std::function<double(double, double)>& f) {
  VectorXd values(static_cast<Index>(a.values.size() * b.values.size()));
  Index at = 0;
  for (const double x : a.values) {
    for (const double y : b.values) values[at++] = f(x, y);
  }
  const auto share = 1.0 / static_cast<double>(values.size());
  return form_of({a, b}, values, VectorXd::Constant(values.size(), share));
}

TEST(TableForm, IsTheProductThatTheTableIs) {
  const TableAxis phi{"torsion", "rad", spaced(-0.01, 0.01, 7)};
  const TableAxis w{"velocity", "rad/s", spaced(-0.2, 0.2, 6)};
  EXPECT_EQ(form_over(phi, w, [](double x, double y) { return -35.25 * x * std::abs(y); }),
            "tau += -35.2 phi |w|");
  EXPECT_EQ(form_over(phi, w, [](double x, double y) { return 400.0 * x * y + 1.5 * y; }),
            "tau += 400 phi w + 1.5 w");
}

TEST(TableForm, OfAMotorAngleIsItsHarmonics) {
  const TableAxis angle{"motor_angle", "rad", spaced(0.0, 6.28, 13)};
  VectorXd values(13);
  for (Index k = 0; k < 13; ++k) {
    values[k] = 2.0 * std::sin(2.0 * angle.values[static_cast<std::size_t>(k)]);
  }
  EXPECT_EQ(form_of({angle}, values, VectorXd::Constant(13, 1.0 / 13.0)),
            "tau += 2 sin(2 theta_m)");
}

TEST(TableForm, OfNothingThatAFormulaFollowsIsEmpty) {
  const TableAxis x{"velocity", "rad/s", spaced(-1.0, 1.0, 12)};
  EXPECT_EQ(form_of({x}, drawn(11, 12).matrix(), VectorXd::Constant(12, 1.0 / 12.0)), "");
  EXPECT_EQ(form_of({x}, VectorXd::Zero(12), VectorXd::Constant(12, 1.0 / 12.0)), "");
}

}  // namespace
}  // namespace flexspline::studies
