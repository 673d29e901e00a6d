// Starts of fits: from the measurements alone, and many of them.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "flexspline/estimators/multistart.hpp"
#include "ode_fit/equation_error.hpp"
#include "ode_fit/smooth_states.hpp"
#include "ode_fit_fixture.hpp"
#include "polynomial_gear.hpp"

namespace flexspline::estimators {
namespace {

using ::testing::HasSubstr;

// A cubic has a curvature, so it is only approached; a line has none and is met.
TEST(SmoothCurve, MeetsALineAndFollowsASine) {
  std::vector<double> time;
  std::vector<double> line;
  std::vector<double> sine;
  std::mt19937_64 engine(3);
  std::normal_distribution<double> normal;
  for (int k = 0; k <= 200; ++k) {
    time.push_back(0.05 * k);
    line.push_back(2.0 - 0.7 * time.back());
    sine.push_back(std::sin(time.back()) + 0.05 * normal(engine));
  }
  const std::vector<double> weight(time.size(), 1.0);
  const SmoothCurve straight(time, line, weight);
  const SmoothCurve wave(time, sine, weight);
  for (double t : {0.0, 1.234, 7.0, 10.0}) {
    EXPECT_NEAR(straight.value(t), 2.0 - 0.7 * t, 1e-6);
    EXPECT_NEAR(straight.slope(t), -0.7, 1e-6);
  }
  for (double t : {1.0, 2.5, 6.0, 9.0}) {
    EXPECT_NEAR(wave.value(t), std::sin(t), 0.04);
    EXPECT_NEAR(wave.slope(t), std::cos(t), 0.12);
  }
}

TEST(EquationError, StartsNearTheTruthWhateverTheStart) {
  for (double start : {0.01, 50.0}) {
    auto problem = decay(0.002);
    problem.parameters[0].start = start;
    const auto q = equation_error_start(lay_out(problem));
    ASSERT_TRUE(q);
    EXPECT_NEAR((*q)[0], 0.7, 0.1);
    EXPECT_NEAR((*q)[1], 2.0, 0.25) << "read off half a sample step before the first";
  }
}

TEST(EquationError, NeedsEveryStateShown) {
  auto problem = decay();
  problem.experiments[0].observation = Eigen::MatrixXd::Zero(1, 1);
  EXPECT_FALSE(equation_error_start(lay_out(problem)));
}

TEST(Multistart, TellsItsRateOfConvergence) {
  const auto found =
      fit_ode_from_many(decay(0.01), OdeFitMethod::single_shooting, {}, {.starts = 8});
  ASSERT_TRUE(found) << found.error().message();
  EXPECT_EQ(found->at_best, 8);
  EXPECT_EQ(found->costs.size(), 8u);
  EXPECT_DOUBLE_EQ(found->rate, 1.0);
  // Clopper and Pearson: 0.025^(1/8).
  EXPECT_NEAR(found->rate_lower, std::pow(0.025, 1.0 / 8.0), 1e-9);
  EXPECT_THAT(found->says, HasSubstr("8 of 8 starts"));
  EXPECT_EQ(found->best.termination, Termination::converged);
}

TEST(Multistart, EndsOnceEnoughStartsAgree) {
  const auto found =
      fit_ode_from_many(decay(0.01), OdeFitMethod::single_shooting, {}, {.starts = 8, .enough = 2});
  ASSERT_TRUE(found) << found.error().message();
  EXPECT_EQ(found->starts, 2);
  EXPECT_EQ(found->at_best, 2);
}

// y = sin(k t) sampled once: minima at every k with sin k = 0.5, no two starts at one of them.
class Turn final : public OdeLaw<Turn> {
 public:
  std::size_t states() const override { return 2; }
  std::size_t parameters() const override { return 1; }
  template <class S>
  void law(double, std::span<const S> y, std::span<const S> p, std::span<S> ydot) const {
    ydot[0] = S(p[0] * y[1]);
    ydot[1] = S(-S(p[0] * y[0]));
  }
};

OdeFitProblem turn(int samples) {
  OdeFitProblem problem = decay();
  problem.system = std::make_shared<Turn>();
  problem.parameters[0] = {.name = "k", .start = 10.0};
  auto& experiment = problem.experiments[0];
  experiment.initial = {0.0, 1.0};
  experiment.observation = Eigen::RowVector2d(1.0, 0.0);
  experiment.times.clear();
  experiment.measured.clear();
  for (int k = 1; k <= samples; ++k) {
    experiment.times.push_back(0.37 * k);
    experiment.measured.push_back(std::sin(9.0 * 0.37 * k) + 0.01 * std::cos(40.0 * k));
  }
  return problem;
}

TEST(Multistart, DoesNotTakeALonelyMinimumForTheBest) {
  const auto found = fit_ode_from_many(turn(40), OdeFitMethod::single_shooting, {},
                                       {.starts = 4, .seed = 2, .spread = 1.5});
  ASSERT_TRUE(found) << found.error().message();
  ASSERT_LT(found->at_best, 2) << found->says;
  EXPECT_EQ(found->best.termination, Termination::no_progress);
  EXPECT_THAT(found->best.notes, ::testing::Contains(HasSubstr("no two starts agree")));
}

TEST(Multistart, AsksForMoreThanOneStart) {
  const auto found = fit_ode_from_many(decay(), OdeFitMethod::collocation, {}, {.starts = 1});
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::usage);
}

// f' > 0, g' > 0 and h within limits, with limits that bind: every point that binds is on its
// limit and no other is beyond it.
TEST(PolynomialTorsionLimits, HoldWhereTheyBind) {
  const std::vector<double> truth = {0.3, 0.9, 2.0, 0.5, 0.5};
  auto problem = gear_recordings(truth, 0.005, 4, 40);
  const auto plain = fit_ode(problem, OdeFitMethod::collocation);
  ASSERT_TRUE(plain) << plain.error().message();
  for (std::size_t k = 0; k < truth.size(); ++k) {
    const auto& p = plain->parameters[k];
    EXPECT_NEAR(p.value, truth[k], 4.0 * p.std) << p.name;
  }
  PolynomialTorsionLimits::Limits limits;
  limits.slope = 0.4;
  limits.highest_h = 1.3;
  problem.inequalities = std::make_shared<PolynomialTorsionLimits>(kGearShape, limits);
  const auto held = fit_ode(problem, OdeFitMethod::collocation);
  ASSERT_TRUE(held) << held.error().message();
  EXPECT_THAT(held->active_inequalities, ::testing::ElementsAre("f' at x = 0", "ln h at x = 1"));
  EXPECT_NEAR(held->parameters[0].value, 0.4, 1e-6);
  EXPECT_NEAR(held->parameters[4].value, std::log(1.3), 1e-6);
  EXPECT_GT(held->cost, plain->cost);
  // The other three are free: the fit with the two held has the same minimum.
  problem.inequalities = nullptr;
  problem.parameters[0] = {.name = "f1", .start = 0.4, .lower = 0.4};
  problem.parameters[4] = {.name = "h1", .start = 0.2, .upper = std::log(1.3)};
  const auto bounded = fit_ode(problem, OdeFitMethod::single_shooting);
  ASSERT_TRUE(bounded) << bounded.error().message();
  EXPECT_NEAR(held->cost / bounded->cost, 1.0, 1e-6);
}

}  // namespace
}  // namespace flexspline::estimators
