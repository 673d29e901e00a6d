// Jacobians of both residuals against differences, and the whitening of the torsion's.
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "gears.hpp"
#include "torsion/start.hpp"
#include "torsion/torque_residuals.hpp"
#include "torsion/torsion_residuals.hpp"
#include "uncertainty/covariance.hpp"

namespace flexspline::estimators {
namespace {

struct Setting {
  std::vector<PreparedRecord> records;
  LinearStart start;
};

// Every term free and away from zero, so that no derivative is trivial.
Setting with_every_term() {
  const auto gear = gear_with_even_h();
  std::vector<TorsionRecord> measurements = {
      measured(gear, {.cycles = 2, .per_cycle = 200}),
      measured(gear, {.amplitude = 0.7, .frequency = 0.5, .cycles = 2, .per_cycle = 200})};
  // A delay would look before the first sample, where the motion is held.
  for (auto& one : measurements) one.valid.front() = false;
  auto records = prepare(measurements, 100000).value();
  auto start = richest_start(records, {.offset = true, .zeros = true}).value();
  start = with_terms(
      start,
      {.h = 3, .inertia = true, .delay = true, .offset = true, .zeros = true, .initial = true});
  auto& p = start.p;
  const auto& layout = start.layout;
  for (std::size_t k = 0; k < 3; ++k)
    p[layout.h_group.first + k] = 0.1 + 0.05 * static_cast<double>(k);
  p[layout.inertia_group.first] = 0.02 * kPeak / kAmplitude;
  p[layout.delay_group.first] = 0.21;
  p[layout.offset_group.first] = 0.1;
  p[layout.zero_group.first] = 0.02 * kAmplitude;
  p[layout.zero_group.first + 1] = -0.013 * kAmplitude;
  p[layout.initial_group.first + 1] = 0.03 * kAmplitude;
  return {std::move(records), std::move(start)};
}

Eigen::VectorXd residuals_at(const LeastSquaresProblem& problem, const std::vector<double>& p) {
  std::vector<double> all;
  for (std::size_t b = 0; b < problem.blocks(); ++b) {
    std::vector<double> part(problem.residuals(b));
    EXPECT_TRUE(problem.evaluate(b, p, part, {}));
    all.insert(all.end(), part.begin(), part.end());
  }
  return Eigen::Map<Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

Eigen::VectorXd central_difference(const LeastSquaresProblem& problem, std::vector<double> p,
                                   std::size_t k, double step) {
  const double middle = p[k];
  p[k] = middle + step;
  const Eigen::VectorXd up = residuals_at(problem, p);
  p[k] = middle - step;
  return (up - residuals_at(problem, p)) / (2.0 * step);
}

// Largest |J - difference| of a column, in units of the largest difference in it. Differences with
// two steps, extrapolated to none (Richardson).
std::vector<double> column_errors(const LeastSquaresProblem& problem,
                                  const std::vector<BoundedParameter>& parameters,
                                  const std::vector<double>& p, double step) {
  const auto at = linearise(problem, p).value();
  std::vector<double> errors;
  for (std::size_t k = 0; k < p.size(); ++k) {
    const double h = step * parameters[k].scale;
    const Eigen::VectorXd difference =
        (4.0 * central_difference(problem, p, k, h) - central_difference(problem, p, k, 2.0 * h)) /
        3.0;
    const Eigen::VectorXd own = at.jacobian.col(static_cast<Eigen::Index>(k));
    errors.push_back((own - difference).cwiseAbs().maxCoeff() /
                     (difference.cwiseAbs().maxCoeff() + 1e-300));
  }
  return errors;
}

TEST(TorsionResiduals, HaveTheJacobianOfTheSimulation) {
  auto [records, start] = with_every_term();
  for (auto& one : records) {
    // Without noise of the torque the filter only divides by the error of the motion: its whitening
    // would differentiate, and with it what the integrator leaves.
    std::ranges::fill(one.effort_sigma, 0.0);
    one.motion_sigma = 1e-2 * kAmplitude;
  }
  TorsionResiduals problem(start.layout, records, {1e-12, 1e-12, 1000000});
  ASSERT_TRUE(problem.weigh(start.p));
  const auto parameters = bounded_parameters(start.layout, records, start.p);
  const auto errors = column_errors(problem, parameters, start.p, 3e-4);
  for (std::size_t k = 0; k < errors.size(); ++k) {
    // The least columns are small against what the integrator leaves in a difference.
    EXPECT_LT(errors[k], 3e-5) << start.layout.name(k);
  }
}

TEST(TorqueResiduals, HaveTheJacobianOfTheLaw) {
  const auto [records, start] = with_every_term();
  const TorqueResiduals problem(start.layout, records);
  const auto parameters = bounded_parameters(start.layout, records, start.p);
  const auto errors = column_errors(problem, parameters, start.p, 3e-5);
  for (std::size_t k = 0; k < errors.size(); ++k) {
    const std::string name = start.layout.name(k);
    if (name.starts_with("initial")) continue;  // the torque does not know it
    // The delay moves along splines through samples, whose slopes are those of the motion to
    // second order in the sampling: (2 pi/200)^2 = 1e-3.
    EXPECT_LT(errors[k], name == "delay" ? 3e-3 : 1e-5) << name;
  }
}

TEST(TorsionResiduals, SayWhichRecordCannotBeIntegrated) {
  const auto [records, start] = with_every_term();
  TorsionResiduals problem(start.layout, records, {1e-11, 1e-11, 3});
  ASSERT_TRUE(problem.weigh(start.p));
  const auto at = linearise(problem, start.p);
  ASSERT_FALSE(at);
  EXPECT_NE(at.error().message().find(records.front().record.id), std::string::npos);
}

// The deviation of the torsion under white torque noise, by many small steps of its equation.
struct Deviation {
  PreparedRecord record;
  std::vector<double> decay;
  std::vector<double> gain;
  std::vector<double> residual;
};

Deviation driven_by_noise(unsigned seed) {
  Deviation d{.record = prepare({measured(smooth_gear(), {.cycles = 8, .per_cycle = 500})}, 100000)
                            .value()
                            .front(),
              .decay = {},
              .gain = {},
              .residual = {}};
  auto& one = d.record;
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  const std::size_t n = one.record.time.size();
  constexpr double kTorqueNoise = 0.05;
  constexpr double kMotionError = 2e-6;
  one.motion_sigma = kMotionError;
  one.smooth.motion_error.assign(n, kMotionError);
  one.effort_sigma.assign(one.rows.size(), kTorqueNoise);
  for (std::size_t i = 0; i < n; ++i) {
    d.decay.push_back(-0.08 * (1.2 + std::sin(0.05 * one.record.time[i])));
    d.gain.push_back(8e-5 * (1.5 + std::cos(0.03 * one.record.time[i])));
  }
  double deviation = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double torque = kTorqueNoise * normal(engine);
    one.record.effort[i] = one.smooth.effort[i] + torque;
    d.residual.push_back(deviation + kMotionError * normal(engine));
    if (i + 1 == n) break;
    constexpr int kSteps = 200;
    const double dt = (one.record.time[i + 1] - one.record.time[i]) / kSteps;
    for (int k = 0; k < kSteps; ++k) {
      const double u = (k + 0.5) / kSteps;
      const double decay = (1.0 - u) * d.decay[i] + u * d.decay[i + 1];
      const double gain = (1.0 - u) * d.gain[i] + u * d.gain[i + 1];
      deviation += dt * (decay * deviation + gain * torque);
    }
  }
  return d;
}

TEST(InnovationFilter, MakesThemWhiteAndOfUnitVariance) {
  for (unsigned seed : {1U, 2U, 3U}) {
    auto d = driven_by_noise(seed);
    const double raw = long_run_ratio(d.residual);
    InnovationFilter(d.record, d.decay, d.gain).whiten(d.residual, {}, 0);
    const double n = static_cast<double>(d.residual.size());
    double variance = 0.0;
    for (double r : d.residual) variance += r * r / n;
    // Four standard errors of a variance, and what the colour's own estimate adds.
    EXPECT_NEAR(variance, 1.0, 4.0 * std::sqrt(2.0 / n) + 0.05);
    for (std::size_t lag = 1; lag <= 10; ++lag) {
      double sum = 0.0;
      for (std::size_t i = lag; i < d.residual.size(); ++i) {
        sum += d.residual[i] * d.residual[i - lag] / n;
      }
      EXPECT_NEAR(sum, 0.0, 4.0 / std::sqrt(n)) << "lag " << lag;
    }
    EXPECT_GT(raw, 3.0) << "the residuals were white before";
  }
}

TEST(InnovationFilter, IsNotReachedByARecordWithoutValidSamples) {
  auto record = measured(smooth_gear(), {.cycles = 2, .per_cycle = 200});
  record.id = "spoilt";
  record.valid.assign(record.time.size(), false);
  const auto prepared = prepare({record}, 100000);
  ASSERT_FALSE(prepared.has_value());
  EXPECT_EQ(prepared.error().code, ErrorCode::numerics);
  EXPECT_NE(prepared.error().problem.find("recording spoilt: no sample"), std::string::npos);
  PreparedRecord bare = driven_by_noise(1).record;
  bare.rows.clear();
  bare.effort_sigma.clear();
  const std::vector<double> nothing(bare.record.time.size(), 0.0);
  InnovationFilter(bare, nothing, nothing).whiten({}, {}, 0);  // no crash
}

TEST(InnovationFilter, TreatsJacobiansAsResiduals) {
  auto d = driven_by_noise(4);
  std::vector<double> jacobian;
  for (double r : d.residual) jacobian.insert(jacobian.end(), {r, -2.0 * r});
  InnovationFilter(d.record, d.decay, d.gain).whiten(d.residual, jacobian, 2);
  for (std::size_t i = 0; i < d.residual.size(); ++i) {
    EXPECT_NEAR(jacobian[2 * i], d.residual[i], 1e-9);
    EXPECT_NEAR(jacobian[2 * i + 1], -2.0 * d.residual[i], 1e-9);
  }
}

}  // namespace
}  // namespace flexspline::estimators
