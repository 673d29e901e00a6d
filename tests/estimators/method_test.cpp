// What every estimator promises, and how options are refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gears.hpp"

namespace flexspline::estimators {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// Form and starts for methods that are given one: a spring and a damper.
std::optional<GivenModel> given_for(const MethodRow& row) {
  if (!row.takes_model) return std::nullopt;
  return GivenModel{.model = {.f = {.law = "odd_polynomial",
                                    .scale = kAmplitude,
                                    .knots = {},
                                    .coefficients = {3.0, 0.1}},
                              .g_inverse = {.law = "odd_polynomial",
                                            .scale = kSpeed,
                                            .knots = {},
                                            .coefficients = {4.0, 0.1}},
                              .h = {.law = "bounded_modulation", .knots = {}, .coefficients = {}},
                              .effects = {}},
                    .hold = {},
                    .free = {}};
}

class EveryMethod : public testing::TestWithParam<std::size_t> {
 protected:
  const MethodRow& row() const { return methods()[GetParam()]; }
};

TEST_P(EveryMethod, SaysWhatItIs) {
  EXPECT_FALSE(row().summary.empty());
  EXPECT_FALSE(row().source.empty());
  for (const auto& option : row().options) {
    EXPECT_FALSE(option.meaning.empty()) << option.name;
    if (!option.choices.empty()) continue;
    EXPECT_LT(option.lower, option.upper) << option.name;
    EXPECT_GE(option.value, option.lower) << option.name;
    EXPECT_LE(option.value, option.upper) << option.name;
  }
  EXPECT_TRUE(check_options(row(), {}));
}

TEST_P(EveryMethod, RefusesToFitNothing) {
  const auto estimate = row().fit({});
  ASSERT_FALSE(estimate);
  EXPECT_EQ(estimate.error().code, ErrorCode::bad_data);
  EXPECT_THAT(estimate.error().message(),
              AllOf(HasSubstr("no recording to train on"), HasSubstr("split")));
}

TEST_P(EveryMethod, RefusesARecordWithoutMotion) {
  auto record = measured(smooth_gear(), {});
  record.id = "stuck";
  for (double& x : record.motion) x = 0.001;
  const auto estimate = row().fit({.records = {record}, .options = {}, .model = given_for(row())});
  ASSERT_FALSE(estimate);
  EXPECT_THAT(estimate.error().message(), HasSubstr("stuck"));
}

TEST_P(EveryMethod, ReportsNumbersThatAreNumbers) {
  const auto estimate = row().fit({.records = four_loops(smooth_gear(), {.noise = 0.003}),
                                   .options = {},
                                   .model = given_for(row())});
  ASSERT_TRUE(estimate) << estimate.error().message();
  EXPECT_EQ(estimate->estimator, row().id);
  EXPECT_NE(estimate->termination, Termination::not_run);
  EXPECT_TRUE(std::isfinite(estimate->cost));
  EXPECT_FALSE(estimate->residual.empty());
  EXPECT_GT(estimate->evaluations, 0);
  for (const auto& one : estimate->parameters) {
    EXPECT_TRUE(std::isfinite(one.value)) << one.name;
    EXPECT_FALSE(one.unit.empty()) << one.name;
  }
  for (const auto* law : {&estimate->model.f, &estimate->model.g_inverse, &estimate->model.h}) {
    EXPECT_TRUE(make_law(*law));
  }
  for (const auto& band : estimate->bands) {
    ASSERT_EQ(band.argument.size(), band.lower.size());
    for (std::size_t k = 0; k < band.argument.size(); ++k) {
      EXPECT_LE(band.lower[k], band.value[k]) << band.function;
      EXPECT_GE(band.upper[k], band.value[k]) << band.function;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Catalogue, EveryMethod, testing::Range<std::size_t>(0, methods().size()),
                         [](const auto& param) { return std::string(methods()[param.param].id); });

TEST(Estimate, CannotLookGoodBeforeItRan) {
  const Estimate estimate;
  EXPECT_EQ(estimate.termination, Termination::not_run);
  EXPECT_EQ(name_of(estimate.termination), "not_run");
  EXPECT_TRUE(std::isnan(estimate.cost));
  EXPECT_TRUE(std::isnan(ParameterEstimate().value));
  EXPECT_TRUE(std::isnan(ParameterEstimate().ci95_lower));
  EXPECT_TRUE(std::isnan(RecordingFit().rmse));
  EXPECT_EQ(estimate.identifiability.verdict, "not_computed");
}

TEST(FindMethod, SuggestsTheNearestName) {
  const auto row = find_method("trajectory_cerse");
  ASSERT_FALSE(row);
  EXPECT_EQ(row.error().code, ErrorCode::usage);
  EXPECT_THAT(row.error().message(), HasSubstr("did you mean 'trajectory_ceres'"));
}

std::string refused(const Options& options) {
  const auto checked = check_options(**find_method("trajectory_ceres"), options);
  return checked ? "" : checked.error().message();
}

TEST(CheckOptions, RefusesByNameWithARemedy) {
  EXPECT_THAT(refused({.numbers = {{"tolerence", 1e-6}}, .words = {}}),
              AllOf(HasSubstr("'tolerence'"), HasSubstr("did you mean 'tolerance'")));
  EXPECT_THAT(refused({.numbers = {{"tolerance", 1.0}}, .words = {}}),
              AllOf(HasSubstr("'tolerance'"), HasSubstr("is 1"), HasSubstr("[1e-12, 0.001]")));
  EXPECT_THAT(refused({.numbers = {{"tolerance", std::nan("")}}, .words = {}}), HasSubstr("nan"));
  EXPECT_THAT(refused({.numbers = {{"h", 1.0}}, .words = {}}),
              AllOf(HasSubstr("'h'"), HasSubstr("auto, unity")));
  EXPECT_THAT(refused({.numbers = {}, .words = {{"h", "unitty"}}}),
              AllOf(HasSubstr("'unitty'"), HasSubstr("did you mean 'unity'")));
  EXPECT_THAT(refused({.numbers = {}, .words = {{"samples", "many"}}}), HasSubstr("a number"));
  EXPECT_EQ(refused({.numbers = {{"samples", 500}}, .words = {{"h", "unity"}}}), "");
}

}  // namespace
}  // namespace flexspline::estimators
