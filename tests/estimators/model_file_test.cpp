// The form of a given model, fitted: its numbers come back, and what cannot be fitted is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "flexspline/core/simulate.hpp"
#include "gears.hpp"

namespace flexspline::estimators {
namespace {

using testing::AllOf;
using testing::HasSubstr;

LawSpec polynomial(double scale, std::vector<double> coefficients) {
  return {.law = "odd_polynomial",
          .scale = scale,
          .knots = {},
          .coefficients = std::move(coefficients)};
}

ModelSpec spring_with(std::vector<EffectSpec> effects) {
  return {.f = polynomial(0.1, {20.0, 8.0}),
          .g_inverse = polynomial(0.1, {1.5}),
          .h = {.law = "bounded_modulation", .knots = {}, .coefficients = {}},
          .effects = std::move(effects)};
}

const ModelSpec kTruth = spring_with(
    {{"stribeck_friction",
      {{"excess", 1.2}, {"stribeck_speed", 0.03}, {"exponent", 2.0}, {"smoothing", 0.004}}},
     {"presliding_hysteresis",
      {{"stiffness", 300.0}, {"yield", 0.004}, {"stiffness", 40.0}, {"yield", 0.03}}},
     {"torque_sensor_offset", {{"offset", 0.4}}}});

const ModelSpec kStart = spring_with(
    {{"stribeck_friction",
      {{"excess", 0.3}, {"stribeck_speed", 0.08}, {"exponent", 1.3}, {"smoothing", 0.004}}},
     {"presliding_hysteresis",
      {{"stiffness", 100.0}, {"yield", 0.006}, {"stiffness", 10.0}, {"yield", 0.02}}},
     {"torque_sensor_offset", {{"offset", 0.0}}}});

/// Two sines of other amplitudes and frequencies, one after the other, from a zero of their own.
TorsionRecord along(const ModelSpec& model, double amplitude, double omega, double zero,
                    double middle = 0.0) {
  Motion motion;
  for (int k = 0; k < 1200; ++k) {
    const double t = 0.01 * k;
    motion.time.push_back(t);
    motion.position.push_back(middle +
                              amplitude * (std::sin(omega * t) + 0.3 * std::sin(2.7 * omega * t)));
    motion.velocity.push_back(amplitude * omega *
                              (std::cos(omega * t) + 0.81 * std::cos(2.7 * omega * t)));
    motion.acceleration.push_back(-amplitude * omega * omega *
                                  (std::sin(omega * t) + 2.187 * std::sin(2.7 * omega * t)));
  }
  TorsionRecord record;
  record.id = "a" + std::to_string(amplitude);
  record.time = motion.time;
  record.effort = *simulate_torque(model, motion);
  record.motion = motion.position;
  for (double& x : record.motion) x += zero;
  return record;
}

FitProblem problem_of(const ModelSpec& start) {
  return {.records = {along(kTruth, 0.08, 1.3, 0.0), along(kTruth, 0.03, 2.1, 0.0)},
          .options = {},
          .model = GivenModel{start, {}, {}}};
}

Result<Estimate> fitted(const FitProblem& problem) {
  return (*find_method("model_file"))->fit(problem);
}

double value_of(const Estimate& estimate, const std::string& name) {
  for (const auto& one : estimate.parameters) {
    if (one.name == name) return one.value;
  }
  ADD_FAILURE() << "no " << name;
  return 0.0;
}

TEST(ModelFile, NumbersOfItsFormComeBack) {
  const auto estimate = fitted(problem_of(kStart));
  ASSERT_TRUE(estimate) << estimate.error().message();
  EXPECT_NEAR(value_of(*estimate, "f[0]"), 20.0, 0.05);
  EXPECT_NEAR(value_of(*estimate, "f[1]"), 8.0, 0.05);
  EXPECT_NEAR(value_of(*estimate, "g_inverse[0]"), 1.5, 0.02);
  EXPECT_NEAR(value_of(*estimate, "stribeck_friction.excess"), 1.2, 0.02);
  EXPECT_NEAR(value_of(*estimate, "stribeck_friction.stribeck_speed"), 0.03, 1e-3);
  EXPECT_NEAR(value_of(*estimate, "presliding_hysteresis[0].yield"), 0.004, 1e-4);
  EXPECT_NEAR(value_of(*estimate, "presliding_hysteresis[1].yield"), 0.03, 1e-3);
  EXPECT_NEAR(value_of(*estimate, "torque_sensor_offset.offset"), 0.4, 1e-2);
  for (const auto& fit : estimate->fits) EXPECT_LT(fit.rmse, 5e-3) << fit.id;
}

TEST(ModelFile, EveryRecordingMayHaveItsOwnZero) {
  auto problem = problem_of(kStart);
  problem.records = {along(kTruth, 0.08, 1.3, 0.5), along(kTruth, 0.03, 2.1, -0.2)};
  problem.options.words["zero"] = "each";
  const auto estimate = fitted(problem);
  ASSERT_TRUE(estimate) << estimate.error().message();
  EXPECT_NEAR(value_of(*estimate, "zero[" + problem.records[0].id + "]"), 0.5, 5e-4);
  EXPECT_NEAR(value_of(*estimate, "zero[" + problem.records[1].id + "]"), -0.2, 5e-4);
}

TEST(ModelFile, ZeroOfASmallMotionMayBeFarFromIt) {
  auto problem = problem_of(kStart);
  problem.records = {along(kTruth, 0.08, 1.3, 0.0), along(kTruth, 0.01, 2.1, 0.2, 0.06)};
  problem.options.words["zero"] = "each";
  const auto estimate = fitted(problem);
  ASSERT_TRUE(estimate) << estimate.error().message();
  EXPECT_NEAR(value_of(*estimate, "zero[" + problem.records[1].id + "]"), 0.2, 5e-4);
}

// Of an offset alone least squares is the mean over all samples, 0.4 and 1.4 by their numbers,
// however the longer recording is thinned.
TEST(ModelFile, EverySampleCountsTheSame) {
  auto problem = problem_of(kTruth);
  problem.model->hold = {"f", "g_inverse", "stribeck_friction", "presliding_hysteresis"};
  TorsionRecord& brief = problem.records[1];
  for (auto* series : {&brief.time, &brief.motion, &brief.effort}) series->resize(300);
  for (double& torque : brief.effort) torque += 1.0;
  problem.options.numbers["samples"] = 300;
  const auto estimate = fitted(problem);
  ASSERT_TRUE(estimate) << estimate.error().message();
  EXPECT_NEAR(value_of(*estimate, "torque_sensor_offset.offset"), 0.4 + 300.0 / 1500.0, 2e-3);
}

// The same mean, of weights 1/tau^2 and no more than 1/(0.1 rms)^2.
TEST(ModelFile, ErrorsMayCountRelativeToTheTorque) {
  auto problem = problem_of(kTruth);
  problem.model->hold = {"f", "g_inverse", "stribeck_friction", "presliding_hysteresis"};
  for (double& torque : problem.records[1].effort) torque += 1.0;
  double squares = 0.0;
  for (const auto& one : problem.records) {
    for (const double torque : one.effort) squares += torque * torque / 2400.0;
  }
  std::array<double, 2> weight{};
  for (std::size_t i = 0; i < 2; ++i) {
    for (const double torque : problem.records[i].effort) {
      weight[i] += 1.0 / std::max(torque * torque, 0.01 * squares);
    }
  }
  problem.options.words["weight"] = "relative";
  const auto estimate = fitted(problem);
  ASSERT_TRUE(estimate) << estimate.error().message();
  const double expected = 0.4 + weight[1] / (weight[0] + weight[1]);
  EXPECT_GT(expected, 1.0) << "the even mean is 0.9";
  EXPECT_NEAR(value_of(*estimate, "torque_sensor_offset.offset"), expected, 2e-3);
  for (const auto& fit : estimate->fits)
    EXPECT_NEAR(fit.rmse, fit.id == problem.records[0].id ? expected - 0.4 : 1.4 - expected, 5e-3)
        << "as it is, not weighted";
}

// The level of a spline and an offset are one number but for friction that grows with the load,
// which joins them only after the start.
TEST(ModelFile, StartDoesNotRunAwayAlongWhatOnlyLoadTellsApart) {
  const auto model = [](double level, double offset, double growth) {
    ModelSpec spec =
        spring_with({{"load_dependent_friction",
                      {{"coefficient", growth}, {"smoothing", 0.004}, {"load_smoothing", 0.1}}},
                     {"torque_sensor_offset", {{"offset", offset}}}});
    spec.f = {.law = "free_spline", .scale = 0.1, .knots = {-1.5, 1.5}, .coefficients = {}};
    for (int k = 0; k < 6; ++k) spec.f.coefficients.push_back(level + 0.6 * k);
    return spec;
  };
  auto problem = problem_of(model(1.0, 0.0, 0.1));
  problem.model->hold = {"g_inverse"};
  const auto truth = model(0.5, 0.8, 0.2);
  problem.records = {along(truth, 0.08, 1.3, 0.0), along(truth, 0.03, 2.1, 0.0)};
  const auto estimate = fitted(problem);
  ASSERT_TRUE(estimate) << estimate.error().message();
  EXPECT_NEAR(value_of(*estimate, "torque_sensor_offset.offset"), 0.8, 0.02);
  EXPECT_NEAR(value_of(*estimate, "load_dependent_friction.coefficient"), 0.2, 5e-3);
}

TEST(ModelFile, WhatIsHeldStaysAndWidthsAreHeldUnlessFreed) {
  auto problem = problem_of(kStart);
  problem.model->hold = {"presliding_hysteresis", "f[1]"};
  const auto held = fitted(problem);
  ASSERT_TRUE(held) << held.error().message();
  EXPECT_EQ(held->model.effects[1].parameters, kStart.effects[1].parameters);
  EXPECT_EQ(held->model.f.coefficients[1], kStart.f.coefficients[1]);
  EXPECT_EQ(held->model.effects[0].parameters[3].second, 0.004);
  for (const auto& one : held->parameters) EXPECT_FALSE(one.name.ends_with(".smoothing"));
  problem.model->free = {"stribeck_friction.smoothing"};
  const auto freed = fitted(problem);
  ASSERT_TRUE(freed) << freed.error().message();
  EXPECT_TRUE(std::ranges::any_of(freed->parameters, [](const auto& one) {
    return one.name == "stribeck_friction.smoothing";
  }));
}

ModelSpec gear_with_gap(double half_gap) {
  return spring_with({{"backlash", {{"half_gap", half_gap}, {"rounding", 0.002}}}});
}

/// In a gap as wide as all of the motion nothing tells how wide it is.
FitProblem lost_in_a_gap() {
  auto problem = problem_of(gear_with_gap(0.15));
  problem.records = {along(gear_with_gap(0.02), 0.08, 1.3, 0.0)};
  return problem;
}

TEST(ModelFile, OtherStartsFindTheValleyThatTheOneGivenMisses) {
  auto problem = lost_in_a_gap();
  const auto one = fitted(problem);
  problem.options.numbers["starts"] = 8;
  const auto many = fitted(problem);
  ASSERT_TRUE(one && many);
  EXPECT_GT(one->cost, 100.0 * many->cost);
  EXPECT_NEAR(value_of(*many, "backlash.half_gap"), 0.02, 1e-4);
  EXPECT_EQ(many->termination, Termination::converged);
  EXPECT_TRUE(one->notes.empty());
  ASSERT_FALSE(many->notes.empty());
  EXPECT_THAT(many->notes.back(), HasSubstr("of 8 starts"));
}

TEST(ModelFile, WhatOneStartAloneFindsIsNotTakenForTheMinimum) {
  auto problem = lost_in_a_gap();
  problem.options.numbers["starts"] = 2;
  const auto estimate = fitted(problem);
  ASSERT_TRUE(estimate);
  EXPECT_LT(estimate->cost, 1.0);
  EXPECT_EQ(estimate->termination, Termination::no_progress);
  EXPECT_THAT(estimate->notes.back(), AllOf(HasSubstr("1 of 2 starts"), HasSubstr("no two agree")));
}

TEST(ModelFile, RefusesWhatItCannotFit) {
  auto problem = problem_of(kStart);
  problem.model.reset();
  EXPECT_THAT(fitted(problem).error().message(), HasSubstr("no model to fit"));
  problem = problem_of(kStart);
  problem.model->hold = {"stribeck_friktion"};
  EXPECT_THAT(fitted(problem).error().message(), HasSubstr("stribeck_friktion"));
  problem = problem_of(kStart);
  problem.model->model.effects[0].parameters[0].second = -1.0;
  EXPECT_THAT(fitted(problem).error().message(),
              AllOf(HasSubstr("stribeck_friction.excess"), HasSubstr("-1")));
}

}  // namespace
}  // namespace flexspline::estimators
