#include "flexspline/estimators/separable.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <Eigen/QR>

namespace flexspline::estimators {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kFree = -std::numeric_limits<double>::infinity();
constexpr int kSteps = 60;

VectorXd times(Index count = 80) { return VectorXd::LinSpaced(count, 0.0, 4.0); }

ArrayXd decay(double rate, const VectorXd& t) { return (-rate * t.array()).exp(); }

// What no shape and no sum of a few decays follows.
VectorXd disturbance(const VectorXd& t) { return 0.1 * (7.0 * t.array()).sin(); }

MatrixXd decays(std::span<const double> rates, const VectorXd& t) {
  MatrixXd columns(t.size(), static_cast<Index>(rates.size()));
  for (std::size_t k = 0; k < rates.size(); ++k) {
    columns.col(static_cast<Index>(k)) = decay(rates[k], t);
  }
  return columns;
}

/// One block of decays whose rates are the shapes.
SeparableProblem decay_problem(VectorXd target, std::vector<ShapeBound> rates, double lower) {
  SeparableProblem problem;
  problem.lower = VectorXd::Constant(static_cast<Index>(rates.size()), lower);
  problem.shapes = std::move(rates);
  problem.assemble = [target = std::move(target)](std::span<const double> q) {
    std::vector<Index> index;
    for (std::size_t k = 0; k < q.size(); ++k) index.push_back(static_cast<Index>(k));
    return std::vector<SeparableBlock>{{decays(q, times(target.size())), target, index}};
  };
  return problem;
}

/// Linear blocks alone, without shapes.
SeparableProblem linear_problem(std::vector<SeparableBlock> blocks, VectorXd lower) {
  return {[blocks = std::move(blocks)](std::span<const double>) { return blocks; },
          std::move(lower),
          {}};
}

SeparableFit fitted(const SeparableProblem& problem, int steps = kSteps) {
  const auto fit = fit_separable(problem, steps);
  EXPECT_TRUE(fit.has_value()) << (fit ? "" : fit.error().message());
  return fit ? *fit : SeparableFit{};
}

TEST(Separable, RecoversASumOfTwoDecays) {
  const VectorXd t = times();
  const VectorXd y = 2.0 * decay(0.5, t) - 1.2 * decay(3.0, t);
  const auto fit = fitted(decay_problem(y, {{0.9, 0.1, 1.5}, {5.0, 1.6, 9.0}}, kFree));
  ASSERT_EQ(fit.q.size(), 2U);
  EXPECT_NEAR(fit.q[0], 0.5, 1e-4);
  EXPECT_NEAR(fit.q[1], 3.0, 1e-3);
  EXPECT_NEAR(fit.b[0], 2.0, 1e-3);
  EXPECT_NEAR(fit.b[1], -1.2, 1e-3);
  EXPECT_LT(fit.sum_of_squares, 1e-8);
}

TEST(Separable, ChangesThatAreGivenTakeThePlaceOfColumnsInTheJacobian) {
  const VectorXd t = times();
  const VectorXd y = VectorXd(2.0 * decay(0.5, t) - 1.2 * decay(3.0, t)) + disturbance(t);
  auto problem = decay_problem(y, {{0.9, 0.1, 1.5}, {5.0, 1.6, 9.0}}, kFree);
  const auto by_columns = fitted(problem);
  int built = 0;
  int left = 0;
  problem.assemble = [&built, assemble = problem.assemble](std::span<const double> q) {
    ++built;
    return assemble(q);
  };
  problem.changes = [&](const SeparableFit& fit, std::size_t i, double step) {
    ++left;
    std::vector<double> q = fit.q;
    q[i] += step;
    return std::vector<VectorXd>{(decays(fit.q, t) - decays(q, t)) * fit.b};
  };
  const auto by_changes = fitted(problem);
  EXPECT_EQ(by_changes.evaluations, by_columns.evaluations);
  EXPECT_EQ(built + left, by_changes.evaluations);
  EXPECT_GT(left, built);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(by_changes.q[i], by_columns.q[i], 1e-9);
}

TEST(Separable, EndsWhereAStepGainsTooLittle) {
  const VectorXd t = times();
  const VectorXd y = 2.0 * decay(0.5, t) - 1.2 * decay(3.0, t);
  const auto problem = decay_problem(y, {{0.9, 0.1, 1.5}, {5.0, 1.6, 9.0}}, kFree);
  const auto far = fit_separable(problem, kSteps);
  const auto near = fit_separable(problem, kSteps, 0.9);
  ASSERT_TRUE(far && near);
  EXPECT_LT(near->evaluations, far->evaluations);
  EXPECT_GT(near->sum_of_squares, far->sum_of_squares);
}

TEST(Separable, TheResidualStandsUprightOnEveryFreeColumn) {
  const VectorXd t = times();
  const VectorXd y = VectorXd(2.0 * decay(0.5, t)) + disturbance(t);
  const auto problem = decay_problem(y, {{0.8, 0.1, 2.0}, {4.0, 2.5, 9.0}}, kFree);
  const auto fit = solve_linear(problem, std::vector{0.8, 4.0});
  const auto block = problem.assemble(fit.q).front();
  EXPECT_LT((block.columns.transpose() * fit.residual[0]).lpNorm<Eigen::Infinity>(), 1e-8);
  EXPECT_NEAR(fit.sum_of_squares, fit.residual[0].squaredNorm(), 1e-14);
  EXPECT_NEAR((y - block.columns * fit.b - fit.residual[0]).norm(), 0.0, 1e-14);
}

TEST(Separable, SharedColumnsAreColumnsLikeOthers) {
  const VectorXd t = times();
  const VectorXd y = VectorXd(2.0 * decay(0.5, t)) + disturbance(t);
  const std::vector<double> rates = {0.3, 0.5, 2.0, 3.0};
  const MatrixXd all = decays(rates, t);
  SeparableBlock parted{all.rightCols(1), y, {1, 0, 3, 2}};
  parted.shared = std::make_shared<const SharedColumns>(all.leftCols(3));
  const VectorXd lower = VectorXd::Constant(4, -2.0);
  const auto whole = solve_linear(linear_problem({{all, y, {1, 0, 3, 2}}}, lower), {});
  const auto shared = solve_linear(linear_problem({parted}, lower), {});
  EXPECT_LT((whole.b - shared.b).norm(), 1e-6 * whole.b.norm());
  EXPECT_LT((whole.residual[0] - shared.residual[0]).norm(), 1e-9);
  EXPECT_GT(whole.b.cwiseAbs().minCoeff(), 1e-3) << "every column has a part";
}

TEST(Separable, TheShapeFoundIsTheBestOfAScan) {
  const VectorXd t = times();
  const auto problem =
      decay_problem(VectorXd(2.0 * decay(0.5, t)) + disturbance(t), {{1.5, 0.1, 3.0}}, kFree);
  const auto fit = fitted(problem);
  double best = std::numeric_limits<double>::infinity();
  for (double rate = 0.1; rate <= 3.0; rate += 1e-3) {
    best = std::min(best, solve_linear(problem, std::vector{rate}).sum_of_squares);
  }
  EXPECT_LT(fit.sum_of_squares, best * (1.0 + 1e-6));
  EXPECT_GT(fit.sum_of_squares, 0.1);
}

TEST(Separable, ACoefficientThatWouldBeNegativeRestsOnItsBoundAndTheOthersAreFittedWithoutIt) {
  const VectorXd t = times();
  const VectorXd y = 2.0 * decay(0.5, t) - 1.2 * decay(3.0, t);
  const auto both = solve_linear(decay_problem(y, {{}, {}}, 0.0), std::vector{0.5, 3.0});
  const double alone = decay(0.5, t).matrix().dot(y) / decay(0.5, t).matrix().squaredNorm();
  EXPECT_EQ(both.b[1], 0.0);
  EXPECT_NEAR(both.b[0], alone, 1e-9);
  const VectorXd left = y - VectorXd(alone * decay(0.5, t));
  EXPECT_LT(decay(3.0, t).matrix().dot(left), 0.0) << "more of it would make it worse";
  EXPECT_GT(both.sum_of_squares, 0.1);
}

TEST(Separable, AShapeThatWouldLeaveItsBoundsEndsOnOne) {
  const VectorXd y = 2.0 * decay(0.5, times());
  EXPECT_EQ(fitted(decay_problem(y, {{2.0, 1.0, 3.0}}, kFree)).q[0], 1.0);
  EXPECT_EQ(fitted(decay_problem(y, {{0.2, 0.1, 0.3}}, kFree)).q[0], 0.3);
  EXPECT_NEAR(fitted(decay_problem(y, {{7.0, 0.1, 3.0}}, kFree)).q[0], 0.5, 1e-4)
      << "a start outside is put on the bound";
}

TEST(Separable, AShapePressedAgainstItsBoundEndsTheFitAtOnceAndDoesNotHinderOthers) {
  const VectorXd t = times();
  const auto pressed = fitted(decay_problem(2.0 * decay(0.5, t), {{1.0, 1.0, 3.0}}, kFree));
  EXPECT_EQ(pressed.q[0], 1.0);
  EXPECT_EQ(pressed.evaluations, 2) << "the start, and a difference that says where it is downhill";
  const VectorXd y = 2.0 * decay(0.5, t) - 1.2 * decay(3.0, t);
  const auto both = fitted(decay_problem(y, {{0.9, 0.1, 1.5}, {4.0, 4.0, 9.0}}, kFree));
  const auto alone = fitted(decay_problem(y, {{0.9, 0.1, 1.5}, {4.0, 4.0, 4.0}}, kFree));
  EXPECT_EQ(both.q[1], 4.0);
  EXPECT_NEAR(both.q[0], alone.q[0], 1e-4);
  EXPECT_LT(both.sum_of_squares, alone.sum_of_squares * (1.0 + 1e-6));
}

TEST(Separable, AShapeOfEqualBoundsIsHeldWhileOthersMove) {
  const VectorXd t = times();
  const VectorXd y = 2.0 * decay(0.5, t) - 1.2 * decay(3.0, t);
  const auto fit = fitted(decay_problem(y, {{0.9, 0.1, 1.5}, {3.0, 3.0, 3.0}}, kFree));
  EXPECT_EQ(fit.q[1], 3.0);
  EXPECT_NEAR(fit.q[0], 0.5, 1e-4);
  const auto wrong = fitted(decay_problem(y, {{0.9, 0.1, 1.5}, {5.0, 5.0, 5.0}}, kFree));
  EXPECT_EQ(wrong.q[1], 5.0);
  EXPECT_GT(wrong.sum_of_squares, 100.0 * std::max(fit.sum_of_squares, 1e-12));
}

TEST(Separable, NoStepsLeaveTheShapesAtTheirStart) {
  const VectorXd y = 2.0 * decay(0.5, times());
  const auto fit = fitted(decay_problem(y, {{0.9, 0.1, 1.5}}, kFree), 0);
  EXPECT_EQ(fit.q[0], 0.9);
  EXPECT_GT(fit.sum_of_squares, 1e-2);
}

TEST(Separable, BlocksThatShareACoefficientAreFittedAsOne) {
  const VectorXd t = times(40);
  const VectorXd ones = VectorXd::Ones(40);
  const VectorXd first = 3.0 * t + ones + disturbance(t);
  const VectorXd second = 3.0 * t - 2.0 * ones;
  MatrixXd columns(40, 2);
  columns << t, ones;
  const auto fit =
      solve_linear(linear_problem({{columns, first, {0, 1}}, {columns, second, {0, 2}}},
                                  VectorXd::Constant(3, kFree)),
                   {});
  MatrixXd stacked = MatrixXd::Zero(80, 3);
  stacked << t, ones, VectorXd::Zero(40), t, VectorXd::Zero(40), ones;
  VectorXd target(80);
  target << first, second;
  const VectorXd expected = stacked.colPivHouseholderQr().solve(target);
  EXPECT_LT((fit.b - expected).norm(), 1e-8);
  ASSERT_EQ(fit.residual.size(), 2U);
  EXPECT_NEAR(fit.sum_of_squares, (target - stacked * expected).squaredNorm(), 1e-10);
}

// A mean of two values with weights w: (w1^2 y1 + w2^2 y2)/(w1^2 + w2^2).
TEST(Separable, WeightsAreThoseOfRowsNotOfSquares) {
  const VectorXd one = VectorXd::Ones(1);
  const auto fit = solve_linear(
      linear_problem({{3.0 * one, 3.0 * 5.0 * one, {0}}, {1.0 * one, 1.0 * 1.0 * one, {0}}},
                     VectorXd::Constant(1, kFree)),
      {});
  EXPECT_NEAR(fit.b[0], (9.0 * 5.0 + 1.0) / 10.0, 1e-10);
  EXPECT_NEAR(fit.residual[0][0], 3.0 * (5.0 - 4.6), 1e-9);
}

TEST(Separable, AColumnOfZerosTakesNothing) {
  const VectorXd t = times(20);
  MatrixXd columns(20, 2);
  columns << t, VectorXd::Zero(20);
  const auto fit =
      solve_linear(linear_problem({{columns, 2.0 * t, {0, 1}}}, VectorXd::Constant(2, kFree)), {});
  EXPECT_NEAR(fit.b[0], 2.0, 1e-9);
  EXPECT_EQ(fit.b[1], 0.0);
}

TEST(Separable, AColumnsUnitDoesNotMatter) {
  const VectorXd t = times();
  const VectorXd y = 2.0 * decay(0.5, t) - 1.2 * decay(3.0, t);
  MatrixXd columns(80, 2);
  columns << VectorXd(1e-9 * decay(0.5, t)), VectorXd(1e9 * decay(3.0, t));
  const auto fit =
      solve_linear(linear_problem({{columns, y, {0, 1}}}, VectorXd::Constant(2, kFree)), {});
  EXPECT_NEAR(fit.b[0] * 1e-9, 2.0, 1e-6);
  EXPECT_NEAR(fit.b[1] * 1e9, -1.2, 1e-6);
}

TEST(Separable, RefusesAStartWithoutNumbers) {
  auto problem = decay_problem(VectorXd::Constant(80, std::nan("")), {{0.9, 0.1, 1.5}}, kFree);
  const auto fit = fit_separable(problem, kSteps);
  ASSERT_FALSE(fit.has_value());
  EXPECT_EQ(fit.error().code, ErrorCode::numerics);
}

}  // namespace
}  // namespace flexspline::estimators
