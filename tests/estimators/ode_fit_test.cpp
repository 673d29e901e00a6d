// Fits of differential equations against closed forms.
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "ode_fit_fixture.hpp"

namespace flexspline::estimators {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

class EveryOdeMethod : public ::testing::TestWithParam<OdeFitMethod> {};

INSTANTIATE_TEST_SUITE_P(OdeFit, EveryOdeMethod, ::testing::ValuesIn(kOdeFitMethods),
                         [](const auto& each) { return std::string(name_of(each.param)); });

TEST_P(EveryOdeMethod, FindsTheTruthOfExactData) {
  const auto fit = fit_ode(decay(), GetParam());
  ASSERT_TRUE(fit) << fit.error().message();
  EXPECT_EQ(fit->termination, Termination::converged);
  ASSERT_EQ(fit->parameters.size(), 2u);
  EXPECT_EQ(fit->parameters[0].name, "k");
  EXPECT_NEAR(fit->parameters[0].value, 0.7, 1e-7);
  EXPECT_EQ(fit->parameters[1].name, "y(0)");
  EXPECT_NEAR(fit->parameters[1].value, 2.0, 1e-7);
  EXPECT_LT(fit->cost, 1e-8);
}

// With J = [-t y / s, y / y0 / s] at the solution, the covariance is (J'J)^-1 times the variance
// factor, and intervals are Student's on 5 - 2 degrees of freedom: t(0.975, 3) = 3.18245.
TEST_P(EveryOdeMethod, GivesTheCovarianceOfTheClosedForm) {
  const auto problem = decay(0.02);
  const auto fit = fit_ode(problem, GetParam());
  ASSERT_TRUE(fit) << fit.error().message();
  const double k = fit->parameters[0].value;
  const double y0 = fit->parameters[1].value;
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  double sum = 0.0;
  for (std::size_t i = 0; i < 5; ++i) {
    const double t = problem.experiments[0].times[i];
    const double y = y0 * std::exp(-k * t);
    const Eigen::Vector2d row(-t * y / 0.01, y / y0 / 0.01);
    normal += row * row.transpose();
    const double residual = (y - problem.experiments[0].measured[i]) / 0.01;
    sum += residual * residual;
    EXPECT_NEAR(fit->residuals[i], residual, 1e-5);
  }
  EXPECT_NEAR(fit->cost, 0.5 * sum, 1e-6 * sum);
  const Eigen::Matrix2d covariance = sum / 3.0 * normal.inverse();
  EXPECT_TRUE(fit->covariance.isApprox(covariance, 1e-5)) << fit->covariance;
  const double half = 3.182446305 * std::sqrt(covariance(0, 0));
  EXPECT_NEAR(fit->parameters[0].ci95_upper - k, half, 1e-5 * half);
}

TEST_P(EveryOdeMethod, TakesTheNoiseAsKnownOnRequest) {
  OdeFitSettings settings;
  settings.noise_known = true;
  const auto estimated = fit_ode(decay(0.02), GetParam());
  const auto known = fit_ode(decay(0.02), GetParam(), settings);
  ASSERT_TRUE(estimated && known);
  EXPECT_NEAR(known->parameters[0].std * estimated->noise_factor, estimated->parameters[0].std,
              1e-9);
  EXPECT_NEAR(known->parameters[0].ci95_upper - known->parameters[0].value,
              1.959963985 * known->parameters[0].std, 1e-9);
}

TEST_P(EveryOdeMethod, LeavesOutWhatIsMasked) {
  auto problem = decay();
  problem.experiments[0].measured[2] = kNaN;
  problem.experiments[0].mask = {true, true, false, true, true};
  const auto fit = fit_ode(problem, GetParam());
  ASSERT_TRUE(fit) << fit.error().message();
  EXPECT_EQ(fit->residuals.size(), 4u);
  EXPECT_NEAR(fit->parameters[0].value, 0.7, 1e-7);
}

// Two records of different known starts and one rate; the second is seen doubled, with an offset
// start time.
TEST_P(EveryOdeMethod, SharesParametersBetweenExperiments) {
  auto problem = decay();
  problem.experiments[0].initial = {2.0};
  OdeExperiment second{.id = "second"};
  second.start_time = 3.0;
  second.initial = {5.0};
  second.times = {3.0, 3.5, 4.5};
  second.observation = Eigen::MatrixXd::Constant(1, 1, 2.0);
  for (const double t : second.times) {
    second.measured.push_back(10.0 * std::exp(-0.7 * (t - 3.0)));
  }
  second.sigma = {0.1};
  problem.experiments.push_back(second);
  const auto fit = fit_ode(problem, GetParam());
  ASSERT_TRUE(fit) << fit.error().message();
  ASSERT_EQ(fit->parameters.size(), 1u);
  EXPECT_EQ(fit->residuals.size(), 8u);
  EXPECT_NEAR(fit->parameters[0].value, 0.7, 1e-7);
}

// Data of a decay with k bounded above by 0.5 < 0.7: k ends on the bound, y(0) is then linear.
TEST_P(EveryOdeMethod, DropsActiveBoundsFromTheCovariance) {
  auto problem = decay(0.01);
  problem.parameters[0].upper = 0.5;
  const auto fit = fit_ode(problem, GetParam());
  ASSERT_TRUE(fit) << fit.error().message();
  EXPECT_TRUE(fit->parameters[0].bound_active);
  EXPECT_EQ(fit->parameters[0].value, 0.5);
  EXPECT_TRUE(std::isnan(fit->parameters[0].std));
  double shape = 0.0;
  double match = 0.0;
  for (std::size_t i = 0; i < 5; ++i) {
    const double decayed = std::exp(-0.5 * problem.experiments[0].times[i]);
    shape += decayed * decayed;
    match += decayed * problem.experiments[0].measured[i];
  }
  EXPECT_NEAR(fit->parameters[1].value, match / shape, 1e-6);
  EXPECT_NEAR(fit->parameters[1].std, fit->noise_factor * 0.01 / std::sqrt(shape), 1e-6);
}

// y' = k y^2 from 1 reaches infinity at t = 1/k: a start at k = 0.95 works on [0, 1], steps beyond
// k = 1 do not, and must be taken back.
class Escape final : public OdeLaw<Escape> {
 public:
  std::size_t states() const override { return 1; }
  std::size_t parameters() const override { return 1; }
  template <class S>
  void law(double, std::span<const S> y, std::span<const S> p, std::span<S> ydot) const {
    ydot[0] = S(p[0] * S(y[0] * y[0]));
  }
};

OdeFitProblem escape(double start, double truth) {
  OdeFitProblem problem = decay();
  problem.system = std::make_shared<Escape>();
  problem.parameters[0] = {.name = "k", .start = start};
  auto& experiment = problem.experiments[0];
  experiment.initial = {1.0};
  experiment.times = {0.25, 0.5, 0.75, 1.0};
  experiment.measured.clear();
  for (const double t : experiment.times) experiment.measured.push_back(1.0 / (1.0 - truth * t));
  return problem;
}

TEST_P(EveryOdeMethod, TakesStepsBackThatCannotBeIntegrated) {
  const auto fit = fit_ode(escape(0.1, 0.9), GetParam());
  ASSERT_TRUE(fit) << fit.error().message();
  EXPECT_NEAR(fit->parameters[0].value, 0.9, 1e-6);
}

TEST(OdeFit, SaysWhenTheStartCannotBeIntegrated) {
  const auto fit = fit_ode(escape(1.5, 0.9), OdeFitMethod::single_shooting);
  ASSERT_FALSE(fit);
  EXPECT_EQ(fit.error().code, ErrorCode::numerics);
  EXPECT_THAT(fit.error().message(), AllOf(HasSubstr("single_shooting"), HasSubstr("'first'")));
}

// Where single shooting cannot start, the methods that start from the measurements can.
TEST(OdeFit, StartsFromMeasurementsWhereShootingCannot) {
  const auto fit = fit_ode(escape(1.5, 0.9), OdeFitMethod::collocation);
  ASSERT_TRUE(fit) << fit.error().message();
  EXPECT_NEAR(fit->parameters[0].value, 0.9, 1e-6);
}

}  // namespace
}  // namespace flexspline::estimators
