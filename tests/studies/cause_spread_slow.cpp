#include "diagnosis/proof/cause_spread.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "diagnosis_checks.hpp"
#include "flexspline/studies/diagnosis_json.hpp"

namespace flexspline::studies {
namespace {

/// A bench that hides an offset of the torque sensor: its size is known.
const Diagnosis& with_offset() {
  static const ConcealedCase hidden = drawn_case(Rig::locked, 11, {{"torque_sensor_offset", 0.08}});
  static const Diagnosis d = diagnosed(hidden.recordings);
  return d;
}

TEST(CauseSpread, ParametersHaveMeaningUnitAndAnInterval) {
  ASSERT_EQ(names(with_offset()), (std::vector<std::string>{"torque_sensor_offset"}));
  const CauseParameter& offset = with_offset().causes[0].parameters.at(0);
  EXPECT_EQ(offset.name, "offset");
  EXPECT_EQ(offset.unit, "Nm");
  EXPECT_FALSE(offset.meaning.empty());
  EXPECT_GT(offset.std, 0.0);
  EXPECT_LT(offset.ci95_lower, offset.value);
  EXPECT_GT(offset.ci95_upper, offset.value);
}

// The offset itself is the size: what is hidden is known to the trial's bench.
TEST(CauseSpread, TheIntervalHoldsWhatWasHidden) {
  const ConcealedCase hidden = drawn_case(Rig::locked, 11, {{"torque_sensor_offset", 0.08}});
  const double truth = hidden.answer.effects.at(0).parameters.at(0).value;
  const CauseParameter& offset = with_offset().causes.at(0).parameters.at(0);
  EXPECT_NEAR(offset.value, truth, 4.0 * offset.std + 0.1 * hidden.answer.noise_std);
  EXPECT_LT(offset.std, 0.1 * std::abs(truth));
}

TEST(CauseSpread, SizeSaysOfWhat) {
  const Cause& cause = with_offset().causes.at(0);
  EXPECT_EQ(cause.unit, "Nm");
  EXPECT_NE(cause.size_of.find("largest torque"), std::string::npos);
  EXPECT_NEAR(cause.size, std::abs(cause.parameters.at(0).value), 1e-9);
  EXPECT_GT(cause.size / cause.size_fraction, 10.0) << "the bench's largest torque";
}

// Elements that the fit set to 0 are no parameters; grid values are not fitted, and say so.
TEST(CauseSpread, ZeroElementsAreLeftOut) {
  const Diagnosis d =
      diagnosed(drawn_case(Rig::locked, 202, {{"presliding_hysteresis", 0.06}}).recordings);
  ASSERT_FALSE(d.causes.empty());
  std::size_t intervals = 0;
  for (const CauseParameter& one : d.causes[0].parameters) {
    EXPECT_NE(one.value, 0.0) << one.name;
    EXPECT_FALSE(one.meaning.empty()) << one.name;
    EXPECT_FALSE(one.unit.empty()) << one.name;
    EXPECT_TRUE(std::isfinite(one.ci95_lower) != !one.no_interval.empty()) << one.name;
    intervals += std::isfinite(one.ci95_lower) ? 1 : 0;
  }
  EXPECT_GT(intervals, 0U);
}

TEST(Terms, EveryColumnOfEveryCauseIsNamed) {
  for (const CauseRow& row : causes()) {
    for (const CauseForm& form : row.forms) {
      EXPECT_EQ(form.columns != nullptr, form.terms != nullptr) << row.id << " " << form.equation;
    }
  }
}

TEST(Causes, AreListedLargestFirst) {
  const Diagnosis d = diagnosed(
      drawn_case(Rig::locked, 31, {{"torque_sensor_offset", 0.03}, {"presliding_hysteresis", 0.06}})
          .recordings);
  ASSERT_GE(d.causes.size(), 2U);
  for (std::size_t k = 1; k < d.causes.size(); ++k) {
    EXPECT_GE(d.causes[k - 1].size_fraction, d.causes[k].size_fraction);
  }
}

TEST(Causes, NoPValueIsSmallerThanATailIsKnown) {
  for (const Cause& cause : with_offset().causes) EXPECT_GE(cause.evidence.score_p_value, 1e-12);
}

}  // namespace
}  // namespace flexspline::studies
