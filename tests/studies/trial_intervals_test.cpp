#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "trial_fixture.hpp"

namespace flexspline::studies {
namespace {

/// Known to a tenth either way.
CauseParameter known(std::string name, double value, std::string unit) {
  CauseParameter p{std::move(name), value, 0.05, std::move(unit)};
  p.ci95_lower = value - 0.1;
  p.ci95_upper = value + 0.1;
  return p;
}

/// As it is read from a sealed answer.
ConcealedAnswer unsealed(std::vector<data::HiddenParameter> parameters) {
  ConcealedAnswer answer = answer_with(Rig::free, {"position_dependent_friction"});
  answer.effects.front().parameters = std::move(parameters);
  const auto read = answer_from_json(to_json(answer));
  EXPECT_TRUE(read) << (read ? "" : read.error().message());
  return *read;
}

std::vector<GivenInterval> intervals_of(const ConcealedAnswer& answer,
                                        std::vector<CauseParameter> parameters) {
  Cause one = cause("position_dependent_friction");
  one.parameters = std::move(parameters);
  const Diagnosis diagnosis = diagnosis_with(Verdict::explained, {one});
  return score_case(answer, &diagnosis).intervals;
}

TEST(ScoreOfIntervals, OfTheSameNameAndUnit) {
  const auto answer = unsealed({{"width", 2.05, "rad"}, {"height", 3.0, "Nm"}});
  const auto given = intervals_of(answer, {known("width", -2.0, "rad"), known("height", 3.2, "Nm"),
                                           known("height", 3.0, "rad"), known("other", 3.0, "Nm")});
  ASSERT_EQ(given.size(), 2U);
  EXPECT_EQ(given[0].parameter, "position_dependent_friction width_rad");
  EXPECT_EQ(given[0].truth, -2.05) << "with the sign of what was found";
  EXPECT_TRUE(given[0].covers());
  EXPECT_FALSE(given[1].covers());
}

TEST(ScoreOfIntervals, OfAnAmplitudeBySineAndCosine) {
  const auto answer = unsealed({{"amplitude_order_2", 5.05, "Nm"}, {"amplitude", 10.0, "Nm"}});
  const auto given = intervals_of(
      answer,
      {known("sine_2", 3.0, "Nm"), known("cosine_2", -4.0, "Nm"), known("sine", 6.0, "Nm")});
  ASSERT_EQ(given.size(), 1U) << "a sine alone is no amplitude";
  EXPECT_EQ(given[0].parameter, "position_dependent_friction amplitude_order_2_Nm");
  EXPECT_NEAR(given[0].lower, 5.0 - 0.1, 1e-12) << "of errors alike the amplitude has the same";
  EXPECT_NEAR(given[0].upper, 5.0 + 0.1, 1e-12);
}

TEST(ScoreOfIntervals, WithoutAnIntervalIsNone) {
  const auto answer = unsealed({{"width", 2.0, "rad"}});
  CauseParameter untold{"width", 2.0, kNotComputed, "rad"};
  EXPECT_TRUE(intervals_of(answer, {untold}).empty());
}

}  // namespace
}  // namespace flexspline::studies
