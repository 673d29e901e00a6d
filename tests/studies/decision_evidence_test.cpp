#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "decision/evidence.hpp"
#include "decision/noise_model.hpp"

namespace flexspline::studies::decision {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd random_matrix(Index rows, Index columns, unsigned seed) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  return MatrixXd::NullaryExpr(rows, columns, [&] { return normal(generator); });
}

Gram gram_of(const MatrixXd& z, const MatrixXd& w, const VectorXd& y) {
  Gram gram;
  gram.zz = z.transpose() * z, gram.zw = z.transpose() * w, gram.ww = w.transpose() * w;
  gram.zy = z.transpose() * y, gram.wy = w.transpose() * y, gram.yy = y.squaredNorm();
  gram.contrasts = static_cast<double>(y.size());
  return gram;
}

const std::vector<Component> kTwo = {{"torsion", "", 0, 4}, {"load", "", 4, 3}};

// y ~ N(W c, s^2 (I + Z D Z')), with s^2 and c at their maxima: the density itself, by its
// covariance over the rows.
TEST(Evidence, IsTheGaussianIntegralOverTheRandomEffects) {
  const MatrixXd z = random_matrix(60, 7, 1), w = random_matrix(60, 2, 2);
  const VectorXd y = random_matrix(60, 1, 3);
  const VectorXd ratio = (VectorXd(2) << 0.7, 0.2).finished();
  const std::vector<Gram> grams = {gram_of(z, w, y)};
  const std::vector<Reduced> reduced = {reduce(grams[0], kTwo, ratio)};
  const Solution s = solve(grams, reduced, {{0, 1}, {false, false}});
  VectorXd d(7);
  d << VectorXd::Constant(4, 0.7), VectorXd::Constant(3, 0.2);
  const MatrixXd shape = MatrixXd::Identity(60, 60) + z * d.asDiagonal() * z.transpose();
  const MatrixXd inverse = shape.inverse();
  const VectorXd c = (w.transpose() * inverse * w).ldlt().solve(w.transpose() * inverse * y);
  const VectorXd e = y - w * c;
  const double variance = e.dot(inverse * e) / 60.0;
  EXPECT_NEAR((s.c - c).norm(), 0.0, 1e-8);
  EXPECT_NEAR(s.noise[0], variance, 1e-9);
  const MatrixXd covariance = variance * shape;
  const double log_density = -0.5 * e.dot(covariance.inverse() * e) -
                             covariance.llt().matrixLLT().diagonal().array().log().sum() -
                             30.0 * std::log(2.0 * std::numbers::pi);
  EXPECT_NEAR(s.log_likelihood - 30.0 * std::log(2.0 * std::numbers::pi), log_density, 1e-7);
}

TEST(Evidence, RankUpdateEqualsRefit) {
  const MatrixXd z = random_matrix(80, 7, 4), w = random_matrix(80, 5, 5);
  const VectorXd y = random_matrix(80, 1, 6);
  const VectorXd ratio = (VectorXd(2) << 1.5, 0.0).finished();
  Gram grown = gram_of(z, w.leftCols(2), y);
  Reduced updated = reduce(grown, kTwo, ratio);
  append(grown, z.transpose() * w.rightCols(3), w.leftCols(2).transpose() * w.rightCols(3),
         w.rightCols(3).transpose() * w.rightCols(3), w.rightCols(3).transpose() * y);
  extend(updated, grown);
  const Reduced afresh = reduce(gram_of(z, w, y), kTwo, ratio);
  EXPECT_NEAR((updated.s - afresh.s).norm(), 0.0, 1e-10);
  EXPECT_NEAR((updated.t - afresh.t).norm(), 0.0, 1e-10);
}

// Many effects of a known variance, and a component that is not there.
TEST(Evidence, RestrictedLikelihoodFindsAKnownVariance) {
  constexpr Index kEffects = 400;
  constexpr double kVariance = 2.5;
  const MatrixXd one = random_matrix(4000, kEffects, 7), none = random_matrix(4000, 40, 8);
  MatrixXd z(4000, kEffects + 40);
  z << one, none;
  const VectorXd u = std::sqrt(kVariance) * random_matrix(kEffects, 1, 9);
  const VectorXd y = one * u + random_matrix(4000, 1, 10);
  const std::vector<Component> components = {{"torsion", "", 0, kEffects},
                                             {"load", "", kEffects, 40}};
  const std::vector<Gram> grams = {gram_of(z, MatrixXd(4000, 0), y)};
  const std::vector<std::vector<Component>> of_one = {components};
  const auto fit = fit_variances(grams, of_one, {}, {(VectorXd(2) << 0.05, 0.05).finished()}, 40);
  EXPECT_NEAR(fit.ratio[0][0] * fit.solution.noise[0], kVariance,
              3.0 * kVariance * std::sqrt(2.0 / kEffects));
  EXPECT_LT(fit.ratio[0][1], 0.01);
  EXPECT_NEAR(fit.solution.noise[0], 1.0, 0.1);
}

TEST(Evidence, CoefficientsThatMayNotBeNegativeAreBound) {
  const MatrixXd w = random_matrix(200, 3, 11);
  const VectorXd y = w * (VectorXd(3) << 1.0, -2.0, 0.5).finished();
  const std::vector<Gram> grams = {gram_of(MatrixXd(200, 0), w, y)};
  const std::vector<Reduced> reduced = {reduce(grams[0], {}, VectorXd())};
  const Solution s = solve(grams, reduced, {{0, 1, 2}, {true, true, true}});
  EXPECT_EQ(s.c[1], 0.0);
  EXPECT_GT(s.c[0], 0.0);
  EXPECT_EQ(s.active, 2);
}

Rows runs(Index count, Index length) {
  Rows rows;
  for (Index k = 0; k < count; ++k) {
    rows.row.push_back(k);
    rows.behind.push_back(k % length);
    rows.segment.push_back(static_cast<std::size_t>(k / length));
  }
  return rows;
}

VectorXd autoregression(Index count, double rho, unsigned seed) {
  VectorXd v = random_matrix(count, 1, seed);
  for (Index k = 1; k < count; ++k) v[k] = rho * v[k - 1] + std::sqrt(1.0 - rho * rho) * v[k];
  return v;
}

TEST(NoiseModel, FindsAnAutoregressionAndWhitensIt) {
  const Rows rows = runs(20000, 2000);
  const VectorXd v = 0.3 * autoregression(20000, 0.9, 12);
  const NoiseModel noise = fit_noise(rows, 10, v, 100.0);
  ASSERT_GE(noise.order(), 1);
  EXPECT_NEAR(noise.predictor.back().front(), 0.9, 0.03);
  EXPECT_NEAR(noise.inefficiency(), 19.0, 3.0);
  const VectorXd e = whitened(noise, rows, v);
  EXPECT_NEAR(e.head(19999).dot(e.tail(19999)) / e.squaredNorm(), 0.0, 0.02);
  EXPECT_NEAR(e.squaredNorm() / 20000.0, 1.0, 0.05);
}

// A memory of a cycle is a misfit's: it is cut to the time scale that was given.
TEST(NoiseModel, RemembersNoLongerThanItMay) {
  const Rows rows = runs(20000, 2000);
  const NoiseModel noise = fit_noise(rows, 10, autoregression(20000, 0.995, 13), 10.0);
  EXPECT_LT(noise.inefficiency(), 25.0);
}

// (I - L) of a Gaussian process: ln |dx/dv| makes the two densities one.
TEST(NoiseModel, KeepsTheDensity) {
  const Rows rows = runs(50, 25);
  NoiseModel noise = white_noise(rows, {1.0, 2.0});
  noise.predictor = {{}, {0.8}};
  noise.innovation = {1.0 / 0.6, 1.0};
  const VectorXd v = autoregression(50, 0.8, 14);
  MatrixXd covariance = MatrixXd::Zero(50, 50);
  for (Index i = 0; i < 50; ++i) {
    for (Index j = 0; j < 50; ++j) {
      if (i / 25 != j / 25) continue;
      const double scale = i < 25 ? 1.0 : 2.0;
      covariance(i, j) = scale * scale * std::pow(0.8, std::abs(i - j)) / 0.36;
    }
  }
  const VectorXd e = whitened(noise, rows, v);
  const double density = -0.5 * v.dot(covariance.inverse() * v) -
                         covariance.llt().matrixLLT().diagonal().array().log().sum();
  EXPECT_NEAR(-0.5 * e.squaredNorm() + log_jacobian(noise, rows), density, 1e-8);
}

TEST(NoiseModel, KnowsAHeavyTail) {
  const Rows rows = runs(5000, 500);
  VectorXd v = random_matrix(5000, 1, 15);
  const VectorXd chi = random_matrix(5000, 1, 16).cwiseAbs2() +
                       random_matrix(5000, 1, 17).cwiseAbs2() +
                       random_matrix(5000, 1, 18).cwiseAbs2();
  EXPECT_EQ(fit_noise(rows, 10, v, 50.0).freedom, 0.0);
  v = v.cwiseQuotient((chi / 3.0).cwiseSqrt());
  EXPECT_GT(fit_noise(rows, 10, v, 50.0).freedom, 0.0);
}

}  // namespace
}  // namespace flexspline::studies::decision
