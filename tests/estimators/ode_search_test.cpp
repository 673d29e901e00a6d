// Searches without derivatives, where derivatives end in the next valley.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "flexspline/estimators/ode_search.hpp"
#include "ode_fit_fixture.hpp"

namespace flexspline::estimators {
namespace {

using ::testing::HasSubstr;

/// y'' = -w^2 y: every period that is missed is a valley of the cost.
class Oscillator final : public OdeLaw<Oscillator> {
 public:
  std::size_t states() const override { return 2; }
  std::size_t parameters() const override { return 1; }
  template <class S>
  void law(double, std::span<const S> y, std::span<const S> p, std::span<S> ydot) const {
    ydot[0] = y[1];
    ydot[1] = S(-S(p[0] * p[0]) * y[0]);
  }
};

OdeFitProblem oscillation(double start) {
  OdeExperiment one{.id = "ringing"};
  one.initial = {1.0, 0.0};
  one.observation = Eigen::MatrixXd{{1.0, 0.0}};
  one.sigma = {0.1};
  for (int k = 1; k <= 80; ++k) {
    one.times.push_back(0.1 * k);
    one.measured.push_back(std::cos(5.0 * 0.1 * k));
  }
  OdeParameter w{.name = "w", .start = start};
  w.lower = 0.0;
  return {.system = std::make_shared<Oscillator>(),
          .parameters = {w},
          .experiments = {one},
          .state_scale = {1.0, 1.0}};
}

TEST(OdeSearch, ComesHomeFromWhereDerivativesDoNot) {
  const auto problem = oscillation(3.0);
  const auto fit = fit_ode(problem, OdeFitMethod::single_shooting);
  ASSERT_TRUE(fit) << fit.error().message();
  EXPECT_GT(std::abs(fit->parameters.front().value - 5.0), 0.5) << "another valley";
  const auto found = search_ode(std::vector{problem}, {.integration_tolerance = 1e-6},
                                {.searches = 8, .evaluations = 120});
  ASSERT_TRUE(found) << found.error().message();
  EXPECT_NEAR(found->best.front(), 5.0, 0.01);
  EXPECT_EQ(found->costs.size(), 8u);
  EXPECT_THAT(found->says, HasSubstr("of 8 searches without derivatives"));
}

TEST(OdeSearch, DoesNotDependOnItsThreads) {
  const OdeSearchSettings search{.searches = 2, .evaluations = 60, .seed = 3};
  const auto one = search_ode(std::vector{oscillation(3.0)}, {}, search);
  const auto two = search_ode(std::vector{oscillation(3.0), oscillation(3.0)}, {}, search);
  ASSERT_TRUE(one && two);
  EXPECT_EQ(one->best, two->best);
  EXPECT_EQ(one->costs, two->costs);
}

TEST(OdeSearch, StaysWithinTheSpreadOfItsOwnAtFirst) {
  const OdeSearchSettings near{
      .searches = 6, .evaluations = 60, .spread = 2.0, .spreads = {{"w", 1.01}}};
  const auto found = search_ode(std::vector{oscillation(2.0)}, {}, near);
  ASSERT_TRUE(found);
  EXPECT_LT(found->best.front(), 4.0) << "six starts within a percent of 2 end in its valley";
}

TEST(OdeSearch, CostsWhatTheFitSays) {
  const auto problem = oscillation(4.9);
  const auto fit = fit_ode(problem, OdeFitMethod::single_shooting, {.max_iterations = 1});
  ASSERT_TRUE(fit);
  const double at[] = {fit->parameters.front().value};
  EXPECT_NEAR(*ode_cost(problem, {}, at), fit->cost, 1e-6 * fit->cost);
  const double off[] = {3.0};
  EXPECT_GT(*ode_cost(problem, {}, off), 2.0 * fit->cost);
}

TEST(OdeSearch, RefusesSettingsWithoutMeaning) {
  const auto none = search_ode(std::vector{oscillation(3.0)}, {}, {.searches = 0});
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error().message(), HasSubstr("0 searches"));
  EXPECT_FALSE(search_ode({}, {}, {}));
  EXPECT_FALSE(search_ode(std::vector{oscillation(-1.0)}, {}, {})) << "starts below its bound";
}

}  // namespace
}  // namespace flexspline::estimators
