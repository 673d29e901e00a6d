// Descriptions of fits that break their rules are refused by name and value.
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ode_fit_fixture.hpp"

namespace flexspline::estimators {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

class OnlyOnce final : public OdeSystem {
 public:
  std::size_t states() const override { return 1; }
  std::size_t parameters() const override { return 1; }
  void rate(double t, std::span<const double> y, std::span<const double> p,
            std::span<double> ydot) const override {
    Decay().rate(t, y, p, ydot);
  }
  void rate(double t, std::span<const Dual> y, std::span<const Dual> p,
            std::span<Dual> ydot) const override {
    Decay().rate(t, y, p, ydot);
  }
};

TEST(OdeFit, CollocationAsksForSecondDerivatives) {
  auto problem = decay();
  problem.system = std::make_shared<OnlyOnce>();
  EXPECT_TRUE(fit_ode(problem, OdeFitMethod::multiple_shooting));
  const auto fit = fit_ode(problem, OdeFitMethod::collocation);
  ASSERT_FALSE(fit);
  EXPECT_EQ(fit.error().code, ErrorCode::usage);
  EXPECT_THAT(fit.error().message(), HasSubstr("second derivatives"));
}

TEST(OdeFit, NamesTheParametersOfAStartThatCannotBeIntegrated) {
  auto problem = decay();
  problem.parameters[0].start = 1e9;
  const auto fit = fit_ode(problem, OdeFitMethod::single_shooting, {.most_steps = 3});
  ASSERT_FALSE(fit);
  EXPECT_EQ(fit.error().code, ErrorCode::numerics);
  EXPECT_THAT(fit.error().message(), AllOf(HasSubstr("the start of the fit"), HasSubstr("'first'"),
                                           HasSubstr("k = 1e+09"), HasSubstr("y(0) = ")));
}

std::string refusal(const OdeFitProblem& problem) {
  const auto fit = fit_ode(problem, OdeFitMethod::single_shooting);
  if (fit) return "accepted";
  EXPECT_EQ(fit.error().code, ErrorCode::bad_data);
  return fit.error().message();
}

TEST(OdeFit, RefusesAStartOutsideItsBounds) {
  auto problem = decay();
  problem.parameters[0].start = -0.3;
  EXPECT_THAT(refusal(problem),
              AllOf(HasSubstr("'k'"), HasSubstr("-0.3"), HasSubstr("outside its bounds [0, inf]")));
  problem = decay();
  std::get<OdeParameter>(problem.experiments[0].initial[0]).upper = 0.5;
  EXPECT_THAT(refusal(problem), AllOf(HasSubstr("'first'"), HasSubstr("'y(0)'"), HasSubstr("0.5")));
}

TEST(OdeFit, RefusesParametersThatAreNoNumbers) {
  auto problem = decay();
  problem.parameters[0].start = kNaN;
  EXPECT_THAT(refusal(problem), HasSubstr("'k' starts at nan"));
  problem = decay();
  problem.parameters[0].upper = -1.0;
  EXPECT_THAT(refusal(problem), HasSubstr("bounds [0, -1]"));
  problem = decay();
  problem.parameters[0].scale = 0.0;
  EXPECT_THAT(refusal(problem), HasSubstr("'k' has scale 0"));
  problem = decay();
  problem.parameters.clear();
  EXPECT_THAT(refusal(problem), HasSubstr("0 parameters described for a system of 1"));
}

TEST(OdeFit, RefusesMeasurementsThatAreNoNumbers) {
  auto problem = decay();
  problem.experiments[0].measured[1] = kNaN;
  EXPECT_THAT(refusal(problem), AllOf(HasSubstr("experiment 'first'"), HasSubstr("output 1"),
                                      HasSubstr("t = 1 is nan")));
}

TEST(OdeFit, RefusesTimesThatDoNotIncrease) {
  auto problem = decay();
  problem.experiments[0].times[2] = 0.5;
  EXPECT_THAT(refusal(problem), HasSubstr("time 0.5 of measurement 3 does not follow 1"));
  problem = decay();
  problem.experiments[0].start_time = 0.75;
  EXPECT_THAT(refusal(problem), HasSubstr("time 0.5 of measurement 1 does not follow 0.75"));
}

TEST(OdeFit, RefusesTablesOfTheWrongSize) {
  auto problem = decay();
  problem.experiments[0].measured.pop_back();
  EXPECT_THAT(refusal(problem), HasSubstr("4 measured values"));
  problem = decay();
  problem.experiments[0].sigma = {0.0};
  EXPECT_THAT(refusal(problem), HasSubstr("sigma of output 1 is 0"));
  problem = decay();
  problem.experiments[0].observation = Eigen::MatrixXd::Ones(1, 3);
  EXPECT_THAT(refusal(problem), HasSubstr("3 columns for 1 states"));
  problem = decay();
  problem.experiments[0].initial.clear();
  EXPECT_THAT(refusal(problem), HasSubstr("0 initial values for 1 states"));
}

}  // namespace
}  // namespace flexspline::estimators
