// Fits of eq. (3) from the torque: the backends against each other and against the law that made
// the records, which are integrated here by CVODES.
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "flexspline/core/simulate.hpp"
#include "flexspline/estimators/method.hpp"

namespace flexspline::estimators {
namespace {

using testing::HasSubstr;

constexpr double kMotion = 0.0035;  // rad
constexpr double kTorque = 20.0;    // Nm

ModelSpec truth(double speed) {
  std::vector<double> g = {8.0 * speed / kTorque, 12.0 * speed / std::pow(kTorque, 3)};
  return {.f = {"odd_polynomial", kMotion, {}, {kTorque, 0.5 * kTorque}, 0.0},
          .g_inverse = {"inverse_odd_polynomial", kMotion, {}, g, 0.0},
          .h = {"exponential_modulation", kMotion, {}, {0.3}, 0.0},
          .effects = {}};
}

TorsionRecord clean_record(const ModelSpec& model, double amplitude, double frequency) {
  TorsionRecord one;
  one.id = std::to_string(amplitude) + "/" + std::to_string(frequency);
  one.frequency_hz = frequency;
  for (int i = 0; i <= 300; ++i) {
    one.time.push_back(3.0 / frequency * i / 300.0);
    one.effort.push_back(amplitude * kTorque *
                         std::sin(2.0 * std::numbers::pi * frequency * one.time.back()));
  }
  one.motion = *simulate_torsion(model, one.time, one.effort, 0.0, {1e-10, 1e-12, 2000000});
  one.valid.assign(one.time.size(), true);
  return one;
}

// Each is integrated once.
TorsionRecord record(double speed, double amplitude, double frequency, double noise) {
  static std::map<std::array<double, 3>, TorsionRecord> made;
  auto found = made.find({speed, amplitude, frequency});
  if (found == made.end()) {
    auto clean = clean_record(truth(speed), amplitude, frequency);
    found = made.emplace(std::array{speed, amplitude, frequency}, std::move(clean)).first;
  }
  TorsionRecord one = found->second;
  std::mt19937_64 engine(7);
  std::normal_distribution<double> normal;
  for (double& x : one.motion) x += noise * kMotion * normal(engine);
  return one;
}

FitProblem problem(double noise, double speed = 1.0) {
  FitProblem result;
  for (const double amplitude : {0.4, 0.9, 1.4}) {
    for (const double frequency : {0.2, 0.6, 1.8}) {
      result.records.push_back(record(speed, amplitude, frequency, noise));
    }
  }
  result.options.numbers = {{"f_terms", 2.0}, {"g_terms", 2.0}, {"h_terms", 1.0}};
  return result;
}

Result<Estimate> fitted(const FitProblem& problem) {
  return (*find_method("torque_driven"))->fit(problem);
}

TEST(TorqueDriven, FindsTheLawThatMadeTheRecords) {
  const auto estimate = fitted(problem(0.0));
  ASSERT_TRUE(estimate) << estimate.error().message();
  EXPECT_EQ(estimate->termination, Termination::converged);
  EXPECT_EQ(estimate->identifiability.verdict, "identifiable");
  const double s = estimate->model.f.scale / kMotion;
  const double wanted[] = {20.0 * s, 10.0 * std::pow(s, 3), 0.4 / s,
                           12.0 / std::pow(kTorque, 3) / s, 0.3 * s * s};
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_NEAR(estimate->parameters[k].value, wanted[k], 2e-4 * wanted[k])
        << estimate->parameters[k].name;
  }
}

class EveryBackend : public testing::TestWithParam<std::pair<const char*, double>> {};

// The slope of the cost vanishes at the optimum, so that costs agree to the square of what the
// integrators differ by.
TEST_P(EveryBackend, ReachesTheSameOptimum) {
  const auto& [backend, speed] = GetParam();
  FitProblem noisy = problem(0.005, speed);
  const auto kernel = fitted(noisy);
  noisy.options.words = {{"backend", backend}};
  const auto other = fitted(noisy);
  ASSERT_TRUE(kernel) << kernel.error().message();
  ASSERT_TRUE(other) << other.error().message();
  EXPECT_EQ(other->termination, Termination::converged);
  EXPECT_NEAR(other->cost, kernel->cost, 2e-5 * kernel->cost);
  for (std::size_t k = 0; k < kernel->parameters.size(); ++k) {
    EXPECT_NEAR(other->parameters[k].value, kernel->parameters[k].value,
                0.05 * kernel->parameters[k].std)
        << kernel->parameters[k].name;
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, EveryBackend,
                         testing::Values(std::pair{"cvodes", 1.0}, std::pair{"cvodes", 30.0},
                                         std::pair{"collocation", 1.0},
                                         std::pair{"collocation", 30.0}));

TEST(TorqueDriven, GivesTheSameBitsWithAnyNumberOfThreads) {
  FitProblem noisy = problem(0.005);
  noisy.options.numbers["threads"] = 1.0;
  const auto one = fitted(noisy);
  noisy.options.numbers["threads"] = 3.0;
  const auto three = fitted(noisy);
  ASSERT_TRUE(one && three);
  for (std::size_t k = 0; k < one->parameters.size(); ++k) {
    EXPECT_EQ(one->parameters[k].value, three->parameters[k].value);
  }
}

TEST(TorqueDriven, IntegratesStiffRecordsImplicitlyAndSaysSo) {
  const auto estimate = fitted(problem(0.005, 100.0));
  ASSERT_TRUE(estimate) << estimate.error().message();
  ASSERT_FALSE(estimate->notes.empty());
  EXPECT_THAT(estimate->notes.front(), HasSubstr("Radau"));
}

// The reference is simulate_torsion above; the tolerance is a promise about the trajectory.
TEST(TorqueDriven, KeepsTheToleranceOfTheIntegration) {
  for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
    FitProblem clean = problem(0.0);
    clean.options.numbers["tolerance"] = tolerance;
    const auto estimate = fitted(clean);
    ASSERT_TRUE(estimate);
    for (const auto& one : estimate->fits) EXPECT_LT(one.rmse, tolerance) << one.id;
  }
}

TEST(TorqueDriven, SaysThatTooManyTermsCannotBeTold) {
  FitProblem small;
  small.records = {record(1.0, 0.3, 0.5, 0.005)};
  small.options.numbers = {{"f_terms", 6.0}, {"g_terms", 6.0}, {"h_terms", 3.0}};
  const auto estimate = fitted(small);
  ASSERT_TRUE(estimate) << estimate.error().message();
  EXPECT_NE(estimate->identifiability.verdict, "identifiable");
}

TEST(TorqueDriven, LeavesOutWhatIsNotValid) {
  FitProblem spoiled = problem(0.0);
  for (std::size_t i = 100; i < 120; ++i) {
    spoiled.records[2].motion[i] = 1.0;
    spoiled.records[2].valid[i] = false;
  }
  spoiled.records[2].amplitude = kMotion;
  const auto estimate = fitted(spoiled);
  ASSERT_TRUE(estimate) << estimate.error().message();
  EXPECT_LT(estimate->cost, 1e-6);
}

TEST(TorqueDriven, RefusesARecordWithoutTorque) {
  FitProblem dead = problem(0.0);
  std::ranges::fill(dead.records[1].effort, 0.0);
  const auto estimate = fitted(dead);
  ASSERT_FALSE(estimate);
  EXPECT_EQ(estimate.error().code, ErrorCode::bad_data);
  EXPECT_THAT(estimate.error().message(), HasSubstr("has no torque"));
}

TEST(TorqueDriven, RefusesFewerSamplesThanCoefficients) {
  FitProblem short_one;
  short_one.records = {problem(0.0).records.front()};
  auto& one = short_one.records.front();
  for (auto* series : {&one.time, &one.motion, &one.effort}) series->resize(17);
  one.valid.resize(17);
  short_one.options.numbers = {{"f_terms", 8.0}, {"g_terms", 8.0}};
  EXPECT_FALSE(fitted(short_one));
}

}  // namespace
}  // namespace flexspline::estimators
