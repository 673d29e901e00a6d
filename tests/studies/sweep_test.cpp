#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "answers/sobol_indices.hpp"
#include "config/sweep_design.hpp"
#include "flexspline/studies/plan.hpp"
#include "study_file.hpp"

namespace flexspline::studies {
namespace {

class Sweep : public testing::Test {
 protected:
  StudyReading read(const std::string& sweep) const {
    const auto reading = read_study(
        folder_.write("study.toml", kHead + sweep + kGrid + kInput + kEstimator + kSecond));
    EXPECT_TRUE(reading) << reading.error().message();
    return *reading;
  }
  void expect_refused(const std::string& sweep, const std::string& says) const {
    const StudyReading reading = read(sweep);
    ASSERT_FALSE(reading.errors.empty()) << sweep;
    const std::string message = reading.errors.front().message();
    EXPECT_NE(message.find(says), std::string::npos) << message;
    EXPECT_GT(reading.errors.front().line, 0) << message;
  }

  const std::string kSecond =
      "[[estimator]]\nid = \"static\"\nmethod = \"static_regression\"\ntrain = \"point\"\n";
  ScratchFolder folder_;
};

TEST_F(Sweep, AProductOfValuesSpacesAndZips) {
  const StudyReading reading = read(
      "[[sweep]]\nkey = \"bench.cycles\"\nvalues = [3, 5]\n"
      "[[sweep]]\nkey = \"bench.angle_noise\"\nunit = \"%\"\nlogspace = { from = 0.1, to = 10, "
      "count = 3 }\n"
      "[[sweep]]\nzip = [{ key = \"bench.samples_per_cycle\", linspace = { from = 100, to = 300, "
      "count "
      "= 3 } }, { key = \"seed\", values = [1, 2, 3] }]\n");
  ASSERT_TRUE(reading.study) << reading.errors.front().message();
  const StudyConfig& study = *reading.study;
  ASSERT_EQ(variants_of(study), 18U);
  const auto made = variant_study(study, 10);  // 1, 0, 1
  ASSERT_TRUE(made) << made.error().message();
  EXPECT_EQ(point_of(study, 10), (std::vector<std::size_t>{1, 0, 1}));
  EXPECT_EQ(made->bench.cycles, 5);
  EXPECT_DOUBLE_EQ(made->bench.sensors.angle_noise, 0.001);
  EXPECT_EQ(made->bench.samples_per_cycle, 200);
  EXPECT_EQ(made->seed, 2U);
  EXPECT_NEAR(variant_study(study, 3)->bench.sensors.angle_noise, 0.01, 1e-15);
}

// What does not depend on a sweep is computed once, at its first point.
TEST_F(Sweep, ACaseStandsOnlyAtPointsThatItDependsOn) {
  const StudyReading reading = read(
      "replicates = 2\n[[sweep]]\nkey = \"estimator.static.options.samples\"\nvalues = [200, 300, "
      "400]\n[[sweep]]\nkey = \"bench.cycles\"\nvalues = [3, 4]\n");
  ASSERT_TRUE(reading.study) << reading.errors.front().message();
  const auto plan = plan_study(*reading.study, "build");
  ASSERT_TRUE(plan) << plan.error().message();
  EXPECT_EQ(plan->size(), 2U * (2 + 3 * 2));
  EXPECT_EQ(plan->unique_fits(), plan->size());
  std::set<std::string> keys, hashes;
  for (std::size_t i = 0; i < plan->size(); ++i) {
    const CasePlan one = plan->at(i);
    EXPECT_FALSE(one.problem);
    EXPECT_TRUE(keys.insert(one.key).second) << one.key;
    EXPECT_TRUE(hashes.insert(one.fit_depends_on).second) << one.key;
    if (one.estimator->id == "paper")
      EXPECT_EQ(point_of(*reading.study, one.variant)[0], 0U);
    else
      EXPECT_EQ(one.estimator->options.numbers.at("samples"),
                200.0 + 100.0 * static_cast<double>(point_of(*reading.study, one.variant)[0]));
  }
}

TEST_F(Sweep, WhatCannotBeIsRefusedWithTheNearestOrTheRemedy) {
  const auto with = [](const std::string& key, const std::string& values) {
    return "[[sweep]]\nkey = \"" + key + "\"\n" + values + "\n";
  };
  expect_refused(with("bench.cylces", "values = [3]"), "did you mean 'cycles'");
  expect_refused(with("bnech.cycles", "values = [3]"), "did you mean 'bench'");
  expect_refused(with("estimator.papr.options.speed", "values = [\"measured\"]"), "'paper'");
  expect_refused(with("estimator.paper.options.sped", "values = [\"measured\"]"), "'speed'");
  expect_refused(with("bench.cycles", "values = [3, 1]"), "bench.cycles = 1");
  expect_refused(with("bench.cycles", "values = []"), "holds no value");
  expect_refused(with("bench.cycles", "values = [nan]"), "neither a finite number");
  expect_refused(with("bench.cycles", "linspace = { from = 3, to = 3, count = 4 }"), "is empty");
  expect_refused(with("bench.cycles", "linspace = { from = nan, to = 3, count = 4 }"),
                 "not a finite number");
  expect_refused(with("bench.cycles", "logspace = { from = 0, to = 3, count = 4 }"), "logarithm");
  expect_refused(with("bench.cycles", ""), "none of values");
  expect_refused(with("replicates", "values = [3]"), "cannot be swept");
  expect_refused(with("bench.angle_noise", "values = [0.1]"), "has no unit");
  expect_refused(with("bench.cycles", "values = [3]") + with("bench.cycles", "values = [4]"),
                 "swept twice");
  expect_refused(
      "[[sweep]]\nzip = [{ key = \"bench.cycles\", values = [3, 4] }, { key = \"seed\", "
      "values = [1] }]\n",
      "as many values");
  expect_refused(
      "[[sweep]]\nsobol = { count = 8, keys = [{ key = \"bench.cycles\", from = 3, to = 3 "
      "}] }\n",
      "is empty");
}

TEST_F(Sweep, AMillionCasesArePlannedByRules) {
  const StudyReading reading = read(
      "replicates = 10\n"
      "[[sweep]]\nkey = \"bench.angle_noise\"\nunit = \"%\"\nlinspace = { from = 0.1, to = 1, "
      "count = 250 }\n"
      "[[sweep]]\nkey = \"bench.torque_noise_white\"\nunit = \"%\"\nlinspace = { from = 0.1, to = "
      "1, "
      "count = 200 }\n");
  ASSERT_TRUE(reading.study) << reading.errors.front().message();
  const auto plan = plan_study(*reading.study, "build");
  ASSERT_TRUE(plan) << plan.error().message();
  EXPECT_EQ(plan->size(), 1'000'000U);
  const CasePlan last = plan->at(999'999);
  EXPECT_EQ(last.key, "unity--static--v49999--r9");
  EXPECT_NEAR(last.study->bench.sensors.angle_noise, 0.01, 1e-12);
}

// Every slice of every dimension holds one point of a Latin hypercube, and every dyadic interval as
// many of a Sobol sequence.
TEST(Designs, FillWhatTheyPromiseToFill) {
  const auto latin = latin_hypercube(50, 3, 9);
  const auto sobol = sobol_points(63, 4);  // 64 with the origin
  for (std::size_t d = 0; d < 3; ++d) {
    std::set<int> slices;
    for (const auto& point : latin) slices.insert(static_cast<int>(50.0 * point[d]));
    EXPECT_EQ(slices.size(), 50U);
  }
  for (std::size_t d = 0; d < 4; ++d) {
    std::vector<int> counts(16, 0);
    counts[0] = 1;
    for (const auto& point : sobol) ++counts[static_cast<std::size_t>(16.0 * point[d])];
    for (const int count : counts) EXPECT_EQ(count, 4) << d;
  }
  EXPECT_EQ(latin_hypercube(50, 3, 9), latin);
  EXPECT_NE(latin_hypercube(50, 3, 10), latin);
}

// Ishigami and Homma (1990), a = 7, b = 0.1: indices in closed form.
TEST(SobolIndices, AreThoseOfTheIshigamiFunction) {
  const double pi = std::acos(-1.0);
  const auto design = saltelli_design(4096, 3);
  std::vector<double> values;
  for (const auto& u : design) {
    const double x = pi * (2 * u[0] - 1), y = pi * (2 * u[1] - 1), z = pi * (2 * u[2] - 1);
    values.push_back(std::sin(x) + 7.0 * std::pow(std::sin(y), 2) +
                     0.1 * std::pow(z, 4) * std::sin(x));
  }
  const double v1 = 0.5 * std::pow(1.0 + 0.1 * std::pow(pi, 4) / 5.0, 2);
  const double v2 = 49.0 / 8.0;
  const double v13 = 0.01 * std::pow(pi, 8) * (1.0 / 18.0 - 1.0 / 50.0);
  const double v = v1 + v2 + v13;
  const auto found = sobol_indices(values, 3);
  const double first[] = {v1 / v, v2 / v, 0.0};
  const double total[] = {(v1 + v13) / v, v2 / v, v13 / v};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(found[i].first, first[i], 0.02) << i;
    EXPECT_NEAR(found[i].total, total[i], 0.02) << i;
    EXPECT_LT(found[i].first_std, 0.05);
  }
  values[5] = std::nan("");  // a case that failed is left out of every block
  EXPECT_NEAR(sobol_indices(values, 3)[0].total, total[0], 0.02);
}

TEST(MorrisEffects, OfALinearFunctionAreItsSlopes) {
  const auto design = morris_design(20, 3, 4);
  std::vector<double> values;
  for (const auto& u : design) {
    for (const double x : u) EXPECT_TRUE(x >= -1e-12 && x <= 1.0 + 1e-12);
    values.push_back(3.0 * u[0] - 2.0 * u[1] + 0.0 * u[2] + 1.0);
  }
  const auto found = morris_effects(design, values, 3);
  EXPECT_NEAR(found[0].mean, 3.0, 1e-9);
  EXPECT_NEAR(found[1].mean, -2.0, 1e-9);
  EXPECT_NEAR(found[1].mean_abs, 2.0, 1e-9);
  EXPECT_NEAR(found[2].mean_abs, 0.0, 1e-9);
  for (const auto& one : found) EXPECT_NEAR(one.deviation, 0.0, 1e-9);
}

}  // namespace
}  // namespace flexspline::studies
