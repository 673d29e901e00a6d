// Least squares within bounds, against the conditions of Karush, Kuhn and Tucker and known minima.
#include <cmath>
#include <limits>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "flexspline/estimators/bounded_least_squares.hpp"
#include "solvers/least_squares.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Random {
  Eigen::MatrixXd a;
  Eigen::VectorXd b;
  Eigen::VectorXd lower;
};

Random random_problem(unsigned seed, Eigen::Index rows, Eigen::Index columns) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  const auto draw = [&] { return normal(engine); };
  Random r{Eigen::MatrixXd::NullaryExpr(rows, columns, draw),
           Eigen::VectorXd::NullaryExpr(rows, draw), Eigen::VectorXd::NullaryExpr(columns, draw)};
  for (Eigen::Index k = 0; k < columns; k += 4) r.lower[k] = -kInfinity;
  return r;
}

TEST(BoundedLeastSquares, MeetsTheConditionsOfAMinimum) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const auto [a, b, lower] = random_problem(seed, 40, 3 + seed % 15);
    const Eigen::VectorXd x = bounded_least_squares(a.transpose() * a, a.transpose() * b, lower);
    const Eigen::VectorXd gradient = a.transpose() * (a * x - b);
    for (Eigen::Index k = 0; k < x.size(); ++k) {
      EXPECT_GE(x[k], lower[k]);
      if (x[k] > lower[k]) {
        EXPECT_NEAR(gradient[k], 0.0, 1e-9) << "inside, seed " << seed;
      } else {
        EXPECT_GE(gradient[k], -1e-9) << "on its bound, seed " << seed;
      }
    }
  }
}

TEST(BoundedLeastSquares, IsThePlainSolutionWhereNoBoundActs) {
  auto [a, b, lower] = random_problem(7, 30, 6);
  lower.setConstant(-100.0);
  const Eigen::VectorXd plain = a.colPivHouseholderQr().solve(b);
  const Eigen::VectorXd x = bounded_least_squares(a.transpose() * a, a.transpose() * b, lower);
  EXPECT_NEAR((x - plain).norm(), 0.0, 1e-10);
  lower.setConstant(-kInfinity);
  const Eigen::VectorXd free = bounded_least_squares(a.transpose() * a, a.transpose() * b, lower);
  EXPECT_NEAR((free - plain).norm(), 0.0, 1e-10);
}

TEST(BoundedLeastSquares, BearsTwinColumns) {
  auto [a, b, lower] = random_problem(9, 30, 5);
  a.col(4) = a.col(3);
  lower.setZero();
  const Eigen::VectorXd x = bounded_least_squares(a.transpose() * a, a.transpose() * b, lower);
  const Eigen::VectorXd gradient = a.transpose() * (a * x - b);
  EXPECT_TRUE(x.allFinite());
  EXPECT_GE(x.minCoeff(), 0.0);
  EXPECT_GE(gradient.minCoeff(), -1e-8);
}

/// 10 (y - x^2), 1 - x: a curved valley whose bottom is (1, 1).
class Rosenbrock final : public LeastSquaresProblem {
 public:
  std::size_t blocks() const override { return 2; }
  std::size_t residuals(std::size_t) const override { return 1; }
  Result<void> evaluate(std::size_t block, std::span<const double> p, std::span<double> residual,
                        std::span<double> jacobian) const override {
    residual[0] = block == 0 ? 10.0 * (p[1] - p[0] * p[0]) : 1.0 - p[0];
    if (jacobian.empty()) return {};
    jacobian[0] = block == 0 ? -20.0 * p[0] : -1.0;
    jacobian[1] = block == 0 ? 10.0 : 0.0;
    return {};
  }
};

constexpr SolverSettings kPatient{
    .max_iterations = 200, .function_tolerance = 1e-14, .parameter_tolerance = 1e-14};

std::vector<BoundedParameter> from_the_valleys_far_end(double upper) {
  return {{.start = -1.2, .lower = -10.0, .upper = upper},
          {.start = 1.0, .lower = -10.0, .upper = 10.0}};
}

TEST(Minimise, FindsTheBottomOfRosenbrocksValley) {
  const auto solution = minimise(Rosenbrock(), from_the_valleys_far_end(10.0), kPatient);
  ASSERT_TRUE(solution);
  EXPECT_EQ(solution->termination, Termination::converged);
  EXPECT_NEAR(solution->p[0], 1.0, 1e-7);
  EXPECT_NEAR(solution->p[1], 1.0, 1e-7);
  EXPECT_NEAR(solution->cost, 0.0, 1e-12);
  EXPECT_THAT(solution->bound_active, testing::ElementsAre(false, false));
}

// With x <= 0.5 the minimum lies on the bound: y = 0.25, cost = (1 - 0.5)^2/2.
TEST(Minimise, StopsAtABound) {
  const auto solution = minimise(Rosenbrock(), from_the_valleys_far_end(0.5), kPatient);
  ASSERT_TRUE(solution);
  EXPECT_NEAR(solution->p[0], 0.5, 1e-6);
  EXPECT_NEAR(solution->p[1], 0.25, 1e-6);
  EXPECT_NEAR(solution->cost, 0.125, 1e-6);
  EXPECT_THAT(solution->bound_active, testing::ElementsAre(true, false));
}

/// p^3 - 1, which a simulation gives up to 1.25 and its derivative up to 1.01.
class NarrowCubic final : public LeastSquaresProblem {
 public:
  std::size_t blocks() const override { return 1; }
  std::size_t residuals(std::size_t) const override { return 1; }
  Result<void> evaluate(std::size_t, std::span<const double> p, std::span<double> residual,
                        std::span<double> jacobian) const override {
    if (p[0] > (jacobian.empty() ? 1.25 : 1.01)) {
      return failure(ErrorCode::numerics, "the integration stopped", "stay below");
    }
    residual[0] = p[0] * p[0] * p[0] - 1.0;
    if (!jacobian.empty()) jacobian[0] = 3.0 * p[0] * p[0];
    return {};
  }
};

// The first step from 0.3 leads to 3.9; shorter ones end between 1 and 1.25, where the cost falls
// but no derivative is to be had.
TEST(Minimise, RejectsTrialPointsWithoutDerivativesWhereItIsAskedTo) {
  const std::vector<BoundedParameter> unknown = {{.start = 0.3, .lower = -1e9, .upper = 1e9}};
  auto settings = kPatient;
  EXPECT_FALSE(minimise(NarrowCubic(), unknown, settings));
  settings.slopes_at_trials = true;
  const auto solution = minimise(NarrowCubic(), unknown, settings);
  ASSERT_TRUE(solution) << solution.error().message();
  EXPECT_EQ(solution->termination, Termination::converged);
  EXPECT_NEAR(solution->p[0], 1.0, 1e-7);
}

/// y - p with unit variance, whose sum of squares an integrator of variable steps leaves rough.
class Rough final : public LeastSquaresProblem {
 public:
  std::size_t blocks() const override { return 1; }
  std::size_t residuals(std::size_t) const override { return 100; }
  Result<void> evaluate(std::size_t, std::span<const double> p, std::span<double> residual,
                        std::span<double> jacobian) const override {
    for (std::size_t i = 0; i < residual.size(); ++i) {
      residual[i] = std::cos(static_cast<double>(i)) + p[0] + 1e-3 * std::sin(1e9 * p[0]);
      if (!jacobian.empty()) jacobian[i] = 1.0;
    }
    return {};
  }
};

// The minimum is that of the mean, with a standard error of 0.1; the roughness is 1/100 of it.
TEST(Minimise, EndsWhereAStepPromisesLessThanIsAskedFor) {
  double mean = 0.0;
  for (int i = 0; i < 100; ++i) mean -= 0.01 * std::cos(static_cast<double>(i));
  const std::vector<BoundedParameter> unknown = {{.start = 5.0, .lower = -1e9, .upper = 1e9}};
  auto settings = kPatient;
  settings.slopes_at_trials = true;
  const auto patient = minimise(Rough(), unknown, settings);
  settings.promise = 0.5 * 0.05 * 0.05;
  const auto prompt = minimise(Rough(), unknown, settings);
  ASSERT_TRUE(patient && prompt);
  EXPECT_EQ(prompt->termination, Termination::converged);
  EXPECT_NEAR(prompt->p[0], mean, 0.05 * 0.1);
  EXPECT_LE(prompt->evaluations, 5);
  EXPECT_GT(patient->evaluations, 2 * prompt->evaluations);
}

TEST(Minimise, LeavesABoundThatItStartsOn) {
  auto parameters = from_the_valleys_far_end(10.0);
  parameters[0] = {.start = 0.0, .lower = 0.0, .upper = 10.0};
  parameters[1] = {.start = 9.0, .lower = -10.0, .upper = 9.0};
  const auto solution = minimise(Rosenbrock(), parameters, kPatient);
  ASSERT_TRUE(solution);
  EXPECT_NEAR(solution->p[0], 1.0, 1e-6);
  EXPECT_NEAR(solution->p[1], 1.0, 1e-6);
}

TEST(Minimise, DoesNotDependOnTheScales) {
  auto parameters = from_the_valleys_far_end(10.0);
  parameters[0].scale = 1e-2;
  parameters[1].scale = 30.0;
  const auto solution = minimise(Rosenbrock(), parameters, kPatient);
  ASSERT_TRUE(solution);
  EXPECT_NEAR(solution->p[0], 1.0, 1e-6);
}

TEST(Minimise, SaysWhenItRanOutOfIterations) {
  SolverSettings hasty = kPatient;
  hasty.max_iterations = 2;
  const auto solution = minimise(Rosenbrock(), from_the_valleys_far_end(10.0), hasty);
  ASSERT_TRUE(solution);
  EXPECT_EQ(solution->termination, Termination::iteration_limit);
}

/// sqrt(p), which has no value below zero.
class Root final : public LeastSquaresProblem {
 public:
  std::size_t blocks() const override { return 1; }
  std::size_t residuals(std::size_t) const override { return 1; }
  Result<void> evaluate(std::size_t, std::span<const double> p, std::span<double> residual,
                        std::span<double> jacobian) const override {
    if (p[0] < 0.0) return failure(ErrorCode::numerics, "no root of a negative number");
    residual[0] = std::sqrt(p[0]) - 0.1;
    if (!jacobian.empty()) jacobian[0] = 0.5 / std::sqrt(p[0]);
    return {};
  }
};

TEST(Minimise, GivesTheReasonWhyAStartFails) {
  const std::vector<BoundedParameter> parameters = {{.start = -1.0, .lower = -9.0, .upper = 9.0}};
  const auto solution = minimise(Root(), parameters, kPatient);
  ASSERT_FALSE(solution);
  EXPECT_EQ(solution.error().code, ErrorCode::numerics);
  EXPECT_THAT(solution.error().message(), testing::HasSubstr("no root of a negative number"));
}

// The full step from 4 goes to -3.6, where there is nothing: a shorter one has to be taken.
TEST(Minimise, TurnsBackWhereNothingCanBeEvaluated) {
  const std::vector<BoundedParameter> parameters = {{.start = 4.0, .lower = -9.0, .upper = 9.0}};
  const auto solution = minimise(Root(), parameters, kPatient);
  ASSERT_TRUE(solution) << solution.error().message();
  EXPECT_NEAR(solution->p[0], 0.01, 1e-6);
}

}  // namespace
}  // namespace flexspline::estimators
