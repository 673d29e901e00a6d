// Losses, noise estimated output by output, coloured noise and degrees of freedom of fits of
// differential equations.
#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "ode_fit/loss.hpp"
#include "ode_fit_fixture.hpp"
#include "uncertainty/coloured_noise.hpp"

namespace flexspline::estimators {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr Loss kRobust[] = {Loss::huber, Loss::soft_l1, Loss::cauchy};

TEST(Loss, HasTheDerivativesItSays) {
  for (const Loss kind : kRobust) {
    const RobustLoss loss{kind, 1.5};
    for (double r : {-4.0, -1.2, 0.3, 1.4, 1.7, 30.0}) {
      constexpr double kStep = 1e-5;
      const double slope = (loss.value(r + kStep) - loss.value(r - kStep)) / (2.0 * kStep);
      const double bend = (loss.influence(r + kStep) - loss.influence(r - kStep)) / (2.0 * kStep);
      EXPECT_NEAR(slope, loss.influence(r), 1e-8) << name_of(kind) << " at " << r;
      EXPECT_NEAR(bend, loss.curvature(r), 1e-8) << name_of(kind) << " at " << r;
      const auto residual = as_residual(loss, r);
      EXPECT_NEAR(0.5 * residual.residual * residual.residual, loss.value(r), 1e-12);
      EXPECT_NEAR(residual.residual * residual.slope, loss.influence(r), 1e-12);
    }
    EXPECT_NEAR(loss.value(1e-3), 5e-7, 1e-12);
  }
}

// y' = 0 from a free start: the fit is a location, here of five numbers with an outlier.
class Rest final : public OdeLaw<Rest> {
 public:
  std::size_t states() const override { return 1; }
  std::size_t parameters() const override { return 0; }
  template <class S>
  void law(double, std::span<const S>, std::span<const S>, std::span<S> ydot) const {
    ydot[0] = S(0.0);
  }
};

OdeFitProblem location(std::vector<double> values) {
  OdeFitProblem problem;
  problem.system = std::make_shared<Rest>();
  OdeExperiment experiment{.id = "first"};
  experiment.initial = {OdeParameter{.name = "level", .start = 0.5}};
  for (std::size_t k = 0; k < values.size(); ++k) {
    experiment.times.push_back(static_cast<double>(k + 1));
  }
  experiment.measured = std::move(values);
  experiment.sigma = {1.0};
  problem.experiments = {experiment};
  problem.state_scale = {1.0};
  return problem;
}

class EveryMethodAndLoss : public ::testing::TestWithParam<std::tuple<OdeFitMethod, Loss>> {};

INSTANTIATE_TEST_SUITE_P(OdeFit, EveryMethodAndLoss,
                         ::testing::Combine(::testing::ValuesIn(kOdeFitMethods),
                                            ::testing::ValuesIn(kRobust)),
                         [](const auto& each) {
                           return std::string(name_of(std::get<0>(each.param))) + "_" +
                                  std::string(name_of(std::get<1>(each.param)));
                         });

TEST_P(EveryMethodAndLoss, SolvesTheEstimatingEquation) {
  const auto [method, kind] = GetParam();
  const std::vector<double> values = {0.1, -0.2, 0.05, 0.15, 9.0};
  const auto fit = fit_ode(location(values), method, {.loss = kind, .loss_scale = 1.0});
  ASSERT_TRUE(fit) << fit.error().message();
  const double level = fit->parameters[0].value;
  const RobustLoss loss{kind, 1.0};
  double balance = 0.0;
  double cost = 0.0;
  for (double v : values) {
    balance += loss.influence(level - v);
    cost += loss.value(level - v);
  }
  EXPECT_NEAR(balance, 0.0, 1e-5);
  EXPECT_NEAR(fit->cost, cost, 1e-6 * cost);
  EXPECT_LT(level, 0.5) << "the mean is 1.82";
  // Huber's location has a closed form: four inside and one that pulls by the scale.
  if (kind == Loss::huber) {
    EXPECT_NEAR(level, (0.1 - 0.2 + 0.05 + 0.15 + 1.0) / 4.0, 1e-6);
  }
}

TEST(OdeFit, HasHubersStandardDeviation) {
  std::mt19937_64 engine(4);
  std::normal_distribution<double> normal;
  std::vector<double> values;
  for (int k = 0; k < 200; ++k) values.push_back(normal(engine) * (k % 10 == 0 ? 10.0 : 1.0));
  const auto robust = fit_ode(location(values), OdeFitMethod::single_shooting,
                              {.loss = Loss::huber, .loss_scale = 1.345});
  const auto square = fit_ode(location(values), OdeFitMethod::single_shooting);
  ASSERT_TRUE(robust && square);
  double influence = 0.0;
  double inside = 0.0;
  for (double v : values) {
    const double r = robust->parameters[0].value - v;
    influence += std::pow(std::clamp(r, -1.345, 1.345), 2) / 199.0;
    inside += std::abs(r) < 1.345 ? 1.0 / 200.0 : 0.0;
  }
  const double correction = 1.0 + (1.0 - inside) / inside / 200.0;
  EXPECT_NEAR(robust->parameters[0].std,
              correction * std::sqrt(influence) / inside / std::sqrt(200.0), 1e-9);
  EXPECT_LT(robust->parameters[0].std, 0.5 * square->parameters[0].std);
}

// Two outputs of one constant state with noise of 0.1 and 10: the estimate goes by the quiet one.
OdeFitProblem two_outputs(unsigned seed) {
  auto problem = location(std::vector<double>(200, 0.0));
  auto& experiment = problem.experiments[0];
  experiment.observation = Eigen::MatrixXd::Ones(2, 1);
  experiment.sigma = {1.0, 1.0};
  experiment.measured.clear();
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 200; ++k) {
    experiment.measured.push_back(3.0 + 0.1 * normal(engine));
    experiment.measured.push_back(3.0 + 10.0 * normal(engine));
  }
  return problem;
}

TEST(OdeFit, WeighsEachOutputByItsOwnNoise) {
  for (const auto method : kOdeFitMethods) {
    const auto fit = fit_ode(two_outputs(3), method, {.weighting = Weighting::per_output});
    ASSERT_TRUE(fit) << fit.error().message();
    ASSERT_EQ(fit->noise.size(), 2u);
    EXPECT_NEAR(fit->noise[0].factor, 0.1, 0.02);
    EXPECT_NEAR(fit->noise[1].factor, 10.0, 2.0);
    EXPECT_NEAR(fit->noise_factor, 1.0, 1e-6);
    EXPECT_NEAR(fit->parameters[0].std, 0.1 / std::sqrt(200.0), 0.0015);
    EXPECT_NEAR(fit->parameters[0].value, 3.0, 4.0 * 0.0071);
  }
}

TEST(OdeFit, TakesAnOutlierOutOfTheNoiseOfItsOutput) {
  auto problem = two_outputs(3);
  problem.experiments[0].measured[10] = 50.0;
  const auto fit = fit_ode(problem, OdeFitMethod::single_shooting,
                           {.loss = Loss::cauchy, .weighting = Weighting::per_output});
  ASSERT_TRUE(fit) << fit.error().message();
  EXPECT_NEAR(fit->noise[0].factor, 0.1, 0.02);
  EXPECT_NEAR(fit->parameters[0].value, 3.0, 0.03);
}

struct Coloured {
  std::vector<double> time;
  std::vector<double> value;
};

// AR(1) of standard deviation 1 and correlation time 3 beside white noise of 0.5, in even steps.
Coloured coloured_noise(int count, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  const double rho = std::exp(-1.0 / 3.0);
  double process = normal(engine);
  Coloured result;
  for (int k = 0; k < count; ++k) {
    if (k > 0) process = rho * process + std::sqrt(1.0 - rho * rho) * normal(engine);
    result.time.push_back(k + 1.0);
    result.value.push_back(process + 0.5 * normal(engine));
  }
  return result;
}

TEST(ColouredNoise, IsFoundByMaximumLikelihood) {
  const auto drawn = coloured_noise(20000, 1);
  const auto noise = estimate_noise(std::vector{TimedSeries{drawn.time, drawn.value}});
  EXPECT_NEAR(noise.share, 1.0 / 1.25, 0.04);
  EXPECT_NEAR(noise.time, 3.0, 0.3);
  EXPECT_NEAR(noise.sigma, std::sqrt(1.25), 0.05);
}

TEST(ColouredNoise, IsNotSeenInWhiteNoise) {
  std::mt19937_64 engine(8);
  std::normal_distribution<double> normal(0.0, 0.7);
  TimedSeries series;
  for (int k = 0; k < 400; ++k) {
    series.time.push_back(k);
    series.value.push_back(normal(engine));
  }
  const auto noise = estimate_noise(std::vector{series});
  EXPECT_EQ(noise.share, 0.0);
  EXPECT_NEAR(noise.sigma, 0.7, 0.08);
}

// The filter is the inverse of a factor of the covariance matrix, also in uneven steps.
TEST(WhiteningFilter, TakesAMatrixColumnByColumn) {
  const std::vector<double> times = {0.0, 0.1, 0.2, 0.5, 0.6, 0.7};
  const WhiteningFilter filter({0.3, 0.6, 0.25}, times);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows =
      Eigen::MatrixXd::Random(6, 3);
  const Eigen::MatrixXd before = rows;
  filter.whiten(rows);
  for (Eigen::Index k = 0; k < rows.cols(); ++k) {
    Eigen::VectorXd column = before.col(k);
    filter.whiten({column.data(), times.size()});
    EXPECT_LT((rows.col(k) - column).cwiseAbs().maxCoeff(), 1e-15);
  }
}

TEST(WhiteningFilter, InvertsTheCovariance) {
  const ColouredNoise noise{1.3, 0.6, 2.0};
  const std::vector<double> times = {0.0, 0.5, 2.0, 2.1, 7.0};
  const auto n = static_cast<Eigen::Index>(times.size());
  Eigen::MatrixXd covariance(n, n);
  for (Eigen::Index a = 0; a < n; ++a) {
    for (Eigen::Index b = 0; b < n; ++b) {
      const double lag = std::abs(times[std::size_t(a)] - times[std::size_t(b)]);
      covariance(a, b) = 1.69 * (0.6 * std::exp(-lag / 2.0) + (a == b ? 0.4 : 0.0));
    }
  }
  const WhiteningFilter filter(noise, times);
  Eigen::MatrixXd w = Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index k = 0; k < n; ++k) filter.whiten({w.col(k).data(), times.size()});
  EXPECT_TRUE((w * covariance * w.transpose()).isApprox(Eigen::MatrixXd::Identity(n, n), 1e-12));
  EXPECT_NEAR(filter.log_variance(), std::log(covariance.determinant()), 1e-12);
}

// The mean of such noise by generalised least squares, and its standard deviation, from the
// covariance matrix itself.
TEST(OdeFit, WeighsColouredNoiseByItsInnovations) {
  const auto drawn = coloured_noise(300, 5);
  auto problem = location(drawn.value);
  const OdeFitSettings settings{.weighting = Weighting::coloured};
  std::vector<double> levels;
  for (const auto method : kOdeFitMethods) {
    const auto fit = fit_ode(problem, method, settings);
    ASSERT_TRUE(fit) << fit.error().message();
    const OutputNoise& noise = fit->noise[0];
    ASSERT_GT(noise.share, 0.3);
    const Eigen::Index n = 300;
    Eigen::MatrixXd covariance(n, n);
    for (Eigen::Index a = 0; a < n; ++a) {
      for (Eigen::Index b = 0; b < n; ++b) {
        const double lag = static_cast<double>(std::abs(a - b));
        covariance(a, b) =
            noise.factor * noise.factor *
            (noise.share * std::exp(-lag / noise.time) + (a == b ? 1.0 - noise.share : 0.0));
      }
    }
    const Eigen::VectorXd weight = covariance.ldlt().solve(Eigen::VectorXd::Ones(n));
    const Eigen::Map<const Eigen::VectorXd> values(drawn.value.data(), n);
    EXPECT_NEAR(fit->parameters[0].value, weight.dot(values) / weight.sum(), 1e-6);
    // That of least squares in noise that is known, and a little for its being estimated.
    const double known = fit->noise_factor / std::sqrt(weight.sum());
    EXPECT_GT(fit->parameters[0].std, 1.02 * known);
    EXPECT_LT(fit->parameters[0].std, 1.15 * known);
    EXPECT_GT(fit->parameters[0].ci95_upper - fit->parameters[0].value, 2.0 * known);
    levels.push_back(fit->parameters[0].value);
  }
  EXPECT_NEAR(levels[0], levels[1], 1e-6);
  EXPECT_NEAR(levels[0], levels[2], 1e-6);
  const auto white = fit_ode(problem, OdeFitMethod::single_shooting);
  ASSERT_TRUE(white);
  const auto coloured = fit_ode(problem, OdeFitMethod::single_shooting, settings);
  EXPECT_GT(coloured->parameters[0].std, 1.7 * white->parameters[0].std);
}

TEST(OdeFit, RefusesSettingsThatDoNotGoTogether) {
  const auto refusal = [](const OdeFitSettings& settings) {
    const auto fit = fit_ode(decay(0.01), OdeFitMethod::single_shooting, settings);
    if (fit) return std::string("accepted");
    EXPECT_EQ(fit.error().code, ErrorCode::usage);
    return fit.error().message();
  };
  EXPECT_THAT(refusal({.loss = Loss::huber, .weighting = Weighting::coloured}),
              AllOf(HasSubstr("huber"), HasSubstr("innovations")));
  EXPECT_THAT(refusal({.loss = Loss::huber, .loss_scale = 0.0}), HasSubstr("loss_scale is 0"));
  EXPECT_THAT(refusal({.uncertainty = {.kind = Uncertainty::bootstrap_block, .replicates = 5}}),
              HasSubstr("5 replicates"));
}

// A rate held on its bound is no parameter that was fitted.
TEST(OdeFit, DoesNotCountWhatIsOnABound) {
  auto problem = decay(0.01);
  problem.parameters[0].upper = 0.5;
  for (const auto method : kOdeFitMethods) {
    const auto fit = fit_ode(problem, method);
    ASSERT_TRUE(fit) << fit.error().message();
    ASSERT_TRUE(fit->parameters[0].bound_active);
    EXPECT_EQ(fit->degrees_of_freedom, 4.0);
    EXPECT_NEAR(fit->noise_factor, std::sqrt(2.0 * fit->cost / 4.0), 1e-6 * fit->noise_factor);
  }
}

// The profile of a rate on its bound still has an end on the other side.
TEST(OdeFit, GivesIntervalsByProfileAndBootstrap) {
  const auto problem = decay(0.02);
  const auto plain = fit_ode(problem, OdeFitMethod::single_shooting);
  ASSERT_TRUE(plain);
  for (const auto kind :
       {Uncertainty::profile, Uncertainty::bootstrap_parametric, Uncertainty::bootstrap_block}) {
    const auto fit = fit_ode(problem, OdeFitMethod::collocation,
                             {.uncertainty = {.kind = kind, .replicates = 300}});
    ASSERT_TRUE(fit) << fit.error().message();
    EXPECT_LT(fit->parameters[0].ci95_lower, fit->parameters[0].value);
    EXPECT_GT(fit->parameters[0].ci95_upper, fit->parameters[0].value);
    if (kind == Uncertainty::bootstrap_parametric) {
      EXPECT_NEAR(fit->parameters[0].std / plain->parameters[0].std, 1.0, 0.2);
    }
  }
  auto bounded = decay(0.01);
  bounded.parameters[0].upper = 0.69;
  const auto fit = fit_ode(bounded, OdeFitMethod::single_shooting,
                           {.uncertainty = {.kind = Uncertainty::profile}});
  ASSERT_TRUE(fit) << fit.error().message();
  ASSERT_TRUE(fit->parameters[0].bound_active);
  EXPECT_EQ(fit->parameters[0].ci95_upper, 0.69);
  EXPECT_LT(fit->parameters[0].ci95_lower, 0.69);
}

}  // namespace
}  // namespace flexspline::estimators
