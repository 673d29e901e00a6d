// Inequalities of the parameters in fits by collocation, against active-set solutions.
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "ode_fit_fixture.hpp"

namespace flexspline::estimators {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// y' = a + b t: y is linear in a and b.
class Ramp final : public OdeLaw<Ramp> {
 public:
  std::size_t states() const override { return 1; }
  std::size_t parameters() const override { return 2; }
  template <class S>
  void law(double t, std::span<const S>, std::span<const S> p, std::span<S> ydot) const {
    ydot[0] = S(p[0] + S(p[1] * S(t)));
  }
};

class Sum final : public OdeInequalityLaw<Sum> {
 public:
  explicit Sum(double most) : most_(most) {}
  std::size_t count() const override { return 1; }
  std::string name(std::size_t) const override { return "a + b"; }
  double lower(std::size_t) const override { return -std::numeric_limits<double>::infinity(); }
  double upper(std::size_t) const override { return most_; }
  template <class S>
  void functions(std::span<const S> p, std::span<S> g) const {
    g[0] = S(p[0] + p[1]);
  }

 private:
  double most_;
};

// a^2 + b^2 >= 1, which has a curvature.
class Outside final : public OdeInequalityLaw<Outside> {
 public:
  std::size_t count() const override { return 1; }
  std::string name(std::size_t) const override { return "radius"; }
  double lower(std::size_t) const override { return 1.0; }
  double upper(std::size_t) const override { return std::numeric_limits<double>::infinity(); }
  template <class S>
  void functions(std::span<const S> p, std::span<S> g) const {
    g[0] = S(S(p[0] * p[0]) + S(p[1] * p[1]));
  }
};

OdeFitProblem ramp(double a, double b, double noise) {
  OdeFitProblem problem;
  problem.system = std::make_shared<Ramp>();
  problem.parameters = {{.name = "a", .start = 0.9}, {.name = "b", .start = 0.9}};
  OdeExperiment experiment{.id = "first"};
  experiment.initial = {0.0};
  for (int k = 1; k <= 8; ++k) {
    const double t = 0.25 * k;
    experiment.times.push_back(t);
    experiment.measured.push_back(a * t + 0.5 * b * t * t + (k % 2 == 0 ? noise : -noise));
  }
  experiment.sigma = {0.1};
  problem.experiments = {experiment};
  problem.state_scale = {1.0};
  return problem;
}

struct LeastSquares {
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
};

LeastSquares equations_of(const OdeFitProblem& problem) {
  LeastSquares result;
  const auto& experiment = problem.experiments[0];
  for (std::size_t k = 0; k < experiment.times.size(); ++k) {
    const double t = experiment.times[k];
    const Eigen::Vector2d row = Eigen::Vector2d(t, 0.5 * t * t) / 0.1;
    result.normal += row * row.transpose();
    result.right += row * experiment.measured[k] / 0.1;
  }
  return result;
}

// Where a + b <= c is active: the least squares solution moved along N^-1 (1, 1) onto a + b = c.
TEST(OdeInequalities, EndAtTheActiveSetSolution) {
  auto problem = ramp(1.0, 1.0, 0.05);
  problem.inequalities = std::make_shared<Sum>(1.5);
  const auto fit = fit_ode(problem, OdeFitMethod::collocation);
  ASSERT_TRUE(fit) << fit.error().message();
  const auto equations = equations_of(problem);
  const Eigen::Matrix2d inverse = equations.normal.inverse();
  const Eigen::Vector2d free = inverse * equations.right;
  const Eigen::Vector2d ones = Eigen::Vector2d::Ones();
  const Eigen::Vector2d expected =
      free - inverse * ones * (free.sum() - 1.5) / ones.dot(inverse * ones);
  EXPECT_EQ(fit->termination, Termination::converged);
  EXPECT_NEAR(fit->parameters[0].value, expected[0], 1e-6);
  EXPECT_NEAR(fit->parameters[1].value, expected[1], 1e-6);
  EXPECT_THAT(fit->active_inequalities, ElementsAre("a + b"));
  // One direction is left: (1, -1) with variance 1 / (u' N u).
  EXPECT_EQ(fit->degrees_of_freedom, 7.0);
  const Eigen::Vector2d along(1.0, -1.0);
  const double variance =
      fit->noise_factor * fit->noise_factor / along.dot(equations.normal * along);
  EXPECT_NEAR(fit->covariance(0, 0) / variance, 1.0, 1e-6);
  EXPECT_NEAR(fit->covariance(0, 1) / variance, -1.0, 1e-6);
}

TEST(OdeInequalities, LeaveAFitAloneWhereTheyDoNotBind) {
  auto problem = ramp(1.0, 1.0, 0.05);
  const auto plain = fit_ode(problem, OdeFitMethod::collocation);
  problem.inequalities = std::make_shared<Sum>(3.0);
  const auto fit = fit_ode(problem, OdeFitMethod::collocation);
  ASSERT_TRUE(plain && fit);
  EXPECT_NEAR(fit->parameters[0].value, plain->parameters[0].value, 1e-7);
  EXPECT_THAT(fit->active_inequalities, IsEmpty());
  EXPECT_EQ(fit->degrees_of_freedom, 6.0);
}

// On the circle N p - r = mu p holds at the minimum: checked by its tangential part.
TEST(OdeInequalities, MayBeCurved) {
  auto problem = ramp(0.3, 0.4, 0.05);
  problem.inequalities = std::make_shared<Outside>();
  const auto fit = fit_ode(problem, OdeFitMethod::collocation);
  ASSERT_TRUE(fit) << fit.error().message();
  const Eigen::Vector2d p(fit->parameters[0].value, fit->parameters[1].value);
  EXPECT_NEAR(p.squaredNorm(), 1.0, 1e-8);
  const auto equations = equations_of(problem);
  const Eigen::Vector2d gradient = equations.normal * p - equations.right;
  EXPECT_NEAR(Eigen::Vector2d(-p[1], p[0]).dot(gradient) / gradient.norm(), 0.0, 1e-6);
  EXPECT_GT(p.dot(gradient), 0.0) << "inside would be cheaper";
}

TEST(OdeInequalities, AreRefusedByShootingAndWhereTheyContradict) {
  auto problem = ramp(1.0, 1.0, 0.05);
  problem.inequalities = std::make_shared<Sum>(1.5);
  const auto shooting = fit_ode(problem, OdeFitMethod::multiple_shooting);
  ASSERT_FALSE(shooting);
  EXPECT_EQ(shooting.error().code, ErrorCode::usage);
  EXPECT_THAT(shooting.error().message(), HasSubstr("inequalities"));
  problem.inequalities = std::make_shared<Sum>(-std::numeric_limits<double>::infinity());
  const auto empty = fit_ode(problem, OdeFitMethod::collocation);
  ASSERT_FALSE(empty);
  EXPECT_THAT(empty.error().message(), HasSubstr("'a + b' has bounds"));
}

}  // namespace
}  // namespace flexspline::estimators
