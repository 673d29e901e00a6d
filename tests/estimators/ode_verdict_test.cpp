// What fits of differential equations say of what the recordings cannot tell.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ode_fit_fixture.hpp"

namespace flexspline::estimators {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

// y' = -(a + b) y tells the sum alone.
class Twins final : public OdeLaw<Twins> {
 public:
  std::size_t states() const override { return 1; }
  std::size_t parameters() const override { return 2; }
  template <class S>
  void law(double, std::span<const S> y, std::span<const S> p, std::span<S> ydot) const {
    ydot[0] = S(-S(S(p[0] + p[1]) * y[0]));
  }
};

TEST(OdeVerdict, NamesWhatTheRecordingsCannotTell) {
  auto problem = decay(0.01);
  problem.system = std::make_shared<Twins>();
  problem.parameters = {{.name = "a", .start = 0.3}, {.name = "b", .start = 0.3}};
  const auto fit = fit_ode(problem, OdeFitMethod::single_shooting);
  ASSERT_TRUE(fit) << fit.error().message();
  const auto& told = fit->identifiability;
  EXPECT_EQ(told.verdict, "not_identifiable");
  EXPECT_NEAR(told.absorbed.front().cosine, 1.0, 1e-9);
  EXPECT_THAT(told.says,
              AllOf(HasSubstr("+1 % of"), HasSubstr("-1 % of"),
                    HasSubstr("is not identifiable from"), HasSubstr("no further recording")));
}

// y1' = -k y1 drives y2' = k y1 - m y2; y1 alone says nothing of m.
class Chain final : public OdeLaw<Chain> {
 public:
  std::size_t states() const override { return 2; }
  std::size_t parameters() const override { return 2; }
  template <class S>
  void law(double, std::span<const S> y, std::span<const S> p, std::span<S> ydot) const {
    ydot[0] = S(-S(p[0] * y[0]));
    ydot[1] = S(S(p[0] * y[0]) - S(p[1] * y[1]));
  }
};

TEST(OdeVerdict, ProposesTheRecordingThatHelps) {
  auto problem = decay(0.01);
  problem.system = std::make_shared<Chain>();
  problem.parameters = {{.name = "k", .start = 0.5}, {.name = "m", .start = 0.4}};
  problem.state_scale = {2.0, 1.0};
  auto& experiment = problem.experiments[0];
  experiment.initial = {2.0, 0.0};
  experiment.observation = Eigen::RowVector2d(1.0, 0.0);
  const auto fit = fit_ode(problem, OdeFitMethod::single_shooting);
  ASSERT_TRUE(fit) << fit.error().message();
  EXPECT_EQ(fit->identifiability.verdict, "not_identifiable");
  EXPECT_THAT(fit->identifiability.says, AllOf(HasSubstr("% of m"), HasSubstr("state 2 measured"),
                                               HasSubstr("over 100-fold")));
  experiment.observation = Eigen::MatrixXd();
  experiment.sigma = {0.01, 0.01};
  experiment.measured.clear();
  for (const double t : experiment.times) {
    experiment.measured.push_back(2.0 * std::exp(-0.7 * t) + 0.003);
    experiment.measured.push_back(2.0 * 0.7 / 0.4 * (std::exp(-0.3 * t) - std::exp(-0.7 * t)) -
                                  0.003);
  }
  const auto both = fit_ode(problem, OdeFitMethod::single_shooting);
  ASSERT_TRUE(both) << both.error().message();
  EXPECT_EQ(both->identifiability.verdict, "identifiable") << both->identifiability.says;
}

// Two columns at an angle: the cosine with the rest is that of the angle, and so is the
// correlation.
TEST(OdeVerdict, HasTheCosineOfTheClosedForm) {
  const auto problem = decay(0.02);
  const auto fit = fit_ode(problem, OdeFitMethod::single_shooting);
  ASSERT_TRUE(fit) << fit.error().message();
  const double cosine =
      std::abs(fit->covariance(0, 1)) / std::sqrt(fit->covariance(0, 0) * fit->covariance(1, 1));
  ASSERT_EQ(fit->identifiability.absorbed.size(), 2u);
  EXPECT_NEAR(fit->identifiability.absorbed[0].cosine, cosine, 1e-9);
  EXPECT_NEAR(fit->identifiability.condition, std::sqrt((1.0 + cosine) / (1.0 - cosine)), 1e-6);
}

}  // namespace
}  // namespace flexspline::estimators
