#include <cmath>

#include <gmock/gmock.h>

#include "trial_fixture.hpp"

namespace flexspline::studies {
namespace {

using enum Verdict;

CaseScore score(const ConcealedAnswer& answer, const Diagnosis& diagnosis) {
  return score_case(answer, &diagnosis);
}

const ConcealedAnswer kNull = answer_with(Rig::locked, {});
const ConcealedAnswer kPlay = answer_with(Rig::locked, {"backlash"});
const ConcealedAnswer kPair = answer_with(Rig::locked, {"backlash", "sensor_delay"});
const ConcealedAnswer kUnknown = answer_with(Rig::free, {"unknown:order"});

TEST(ScoreOfANull, IsRightWhenAdequateAndNothingIsNamed) {
  const CaseScore right = score(kNull, diagnosis_with(adequate, {}));
  EXPECT_EQ(right.kind, CaseKind::null);
  EXPECT_TRUE(right.null_right);
  EXPECT_FALSE(right.detected);
  EXPECT_EQ(right.first_name, "adequate");
  EXPECT_FALSE(score(kNull, diagnosis_with(unexplained, {})).null_right);
  EXPECT_FALSE(score(kNull, diagnosis_with(adequate, {cause("backlash")})).null_right);
}

TEST(ScoreOfAnyCase, UndecidedIsNeitherRightNorAName) {
  for (const ConcealedAnswer* answer : {&kNull, &kPlay, &kUnknown}) {
    const CaseScore open = score(*answer, diagnosis_with(undecided, {}));
    EXPECT_FALSE(open.null_right || open.first_right || open.unknown_right || open.detected);
    EXPECT_EQ(open.first_name, "undecided");
    EXPECT_EQ(open.false_names, 0);
  }
}

TEST(ScoreOfANull, CountsEveryNameAsFalse) {
  const auto named = score(kNull, diagnosis_with(explained, {cause("backlash"), cause("x")}));
  EXPECT_EQ(named.named, 2);
  EXPECT_EQ(named.false_names, 2);
  EXPECT_EQ(named.first_name, "backlash");
}

TEST(ScoreOfASingle, IsExactWhenItAloneIsNamed) {
  const auto right = score(kPlay, diagnosis_with(explained, {cause("backlash")}));
  EXPECT_TRUE(right.first_right && right.exact && right.detected);
  EXPECT_EQ(right.false_names, 0);
}

TEST(ScoreOfASingle, IsFirstButNotExactWithASecondName) {
  const auto more =
      score(kPlay, diagnosis_with(explained, {cause("backlash"), cause("soft_windup")}));
  EXPECT_TRUE(more.first_right);
  EXPECT_FALSE(more.exact);
  EXPECT_EQ(more.false_names, 1);
  const auto late =
      score(kPlay, diagnosis_with(explained, {cause("soft_windup"), cause("backlash")}));
  EXPECT_FALSE(late.first_right || late.exact);
  EXPECT_EQ(late.first_name, "soft_windup");
}

TEST(ScoreOfASingle, TakesTheFirstTwoAlternativesAndNoMore) {
  const auto second =
      score(kPlay, diagnosis_with(explained, {cause("soft_windup", {"x", "backlash"})}));
  EXPECT_TRUE(second.with_alternatives.exact);
  EXPECT_EQ(second.with_alternatives.false_names, 0);
  EXPECT_FALSE(second.exact) << "no class of the truth's says so";
  EXPECT_EQ(second.false_names, 1);
  EXPECT_EQ(second.first_name, "soft_windup");
  const auto third =
      score(kPlay, diagnosis_with(explained, {cause("soft_windup", {"x", "y", "backlash"})}));
  EXPECT_FALSE(third.with_alternatives.first_right);
  EXPECT_EQ(third.with_alternatives.false_names, 1);
}

TEST(ScoreOfASingle, TakesAStructuralTwinWhereItIsOne) {
  const auto diagnosis = diagnosis_with(explained, {cause("motor_torque_offset")});
  const auto twin = score(answer_with(Rig::free, {"direction_asymmetry"}), diagnosis);
  EXPECT_TRUE(twin.exact);
  EXPECT_EQ(twin.first_name, "direction_asymmetry") << "the truth that it is a twin of";
  EXPECT_FALSE(score(answer_with(Rig::locked, {"direction_asymmetry"}), diagnosis).exact);
}

TEST(ScoreOfASingle, WithoutANameIsDetectedAtMost) {
  const auto seen = score(kPlay, diagnosis_with(unexplained, {}));
  EXPECT_TRUE(seen.detected);
  EXPECT_FALSE(seen.first_right || seen.unknown_right || seen.null_right);
  EXPECT_EQ(seen.first_name, "no name");
  EXPECT_FALSE(score(kPlay, diagnosis_with(adequate, {})).detected);
}

TEST(ScoreOfAPair, WantsBothInAnyOrder) {
  const auto both =
      score(kPair, diagnosis_with(explained, {cause("sensor_delay"), cause("backlash")}));
  EXPECT_TRUE(both.pair_both && both.pair_one);
  EXPECT_FALSE(both.first_right || both.exact) << "these are of singles";
  const auto one = score(kPair, diagnosis_with(partly_explained, {cause("backlash")}));
  EXPECT_FALSE(one.pair_both);
  EXPECT_TRUE(one.pair_one);
  const auto none = score(kPair, diagnosis_with(explained, {cause("x")}));
  EXPECT_FALSE(none.pair_both || none.pair_one);
  EXPECT_EQ(none.false_names, 1);
}

TEST(ScoreOfAPair, TakesAStructuralTwinForItsEffectWhereItIsOne) {
  const auto diagnosis =
      diagnosis_with(explained, {cause("backlash"), cause("torque_constant_error")});
  const std::vector<std::string> truth = {"backlash", "torque_sensor_gain"};
  EXPECT_TRUE(score(answer_with(Rig::locked, truth), diagnosis).pair_both);
  const auto elsewhere = score(answer_with(Rig::free, truth), diagnosis);
  EXPECT_FALSE(elsewhere.pair_both);
  EXPECT_TRUE(elsewhere.pair_one);
}

TEST(ScoreOfAnUnknown, IsRightWhenSomethingIsLeftOutAndHasNoName) {
  EXPECT_TRUE(score(kUnknown, diagnosis_with(unexplained, {})).unknown_right);
  EXPECT_TRUE(score(kUnknown, diagnosis_with(partly_explained, {})).unknown_right);
  EXPECT_FALSE(score(kUnknown, diagnosis_with(adequate, {})).unknown_right);
  EXPECT_FALSE(score(kUnknown, diagnosis_with(explained, {})).unknown_right);
  const auto named = score(kUnknown, diagnosis_with(partly_explained, {cause("backlash")}));
  EXPECT_FALSE(named.unknown_right);
  EXPECT_EQ(named.false_names, 1);
}

// With it nothing was left out, and its own name is not wrong either.
TEST(ScoreOfAContainedEffect, IsRightWithoutANameOrWithItsOwn) {
  const auto soft = answer_with(Rig::locked, {"soft_windup"});
  const auto adequately = score(soft, diagnosis_with(adequate, {}));
  EXPECT_EQ(adequately.kind, CaseKind::contained);
  EXPECT_TRUE(adequately.contained_right);
  EXPECT_FALSE(adequately.has_coordinate);
  EXPECT_TRUE(score(soft, diagnosis_with(explained, {cause("soft_windup")})).contained_right);
  const auto falsely = score(soft, diagnosis_with(explained, {cause("backlash")}));
  EXPECT_FALSE(falsely.contained_right);
  EXPECT_EQ(falsely.false_names, 1);
  EXPECT_FALSE(score(soft, diagnosis_with(unexplained, {})).contained_right);
  EXPECT_EQ(score(answer_with(Rig::servo, {"soft_windup"}), diagnosis_with(adequate, {})).kind,
            CaseKind::single)
      << "a matter of the rig";
}

TEST(ScoreOfALocation, TakesTheFirstThreeMismatches) {
  const auto diagnosis = [](const std::vector<std::string>& coordinates) {
    return diagnosis_with(explained, {cause("backlash")}, coordinates);
  };
  EXPECT_TRUE(score(kPlay, diagnosis({"time", "lag", "torsion"})).located);
  EXPECT_FALSE(score(kPlay, diagnosis({"time", "lag", "load", "torsion"})).located);
  EXPECT_TRUE(score(kPair, diagnosis({"lag"})).located) << "of either effect";
  EXPECT_TRUE(score(kUnknown, diagnosis({"motor_angle"})).has_coordinate);
  const auto nowhere = answer_with(Rig::locked, {"unknown:cross"});
  EXPECT_FALSE(score(nowhere, diagnosis({"torsion", ""})).has_coordinate);
  EXPECT_FALSE(score(nowhere, diagnosis({"torsion", ""})).located);
}

TEST(ScoreOfAHoldout, IsAgainstNoiseAndAgainstTheBestPossible) {
  const auto right = score(kPlay, diagnosis_with(explained, {cause("backlash")}));
  EXPECT_NEAR(right.after_over_noise, 1.2, 1e-12);
  EXPECT_NEAR(right.after_over_best, 1.5, 1e-12);
  EXPECT_NEAR(right.gain_share, 0.28 / 0.32, 1e-12);
  // Noise of a servo's motor, 1/50 of that at the output, where errors are told.
  ConcealedAnswer servo = kPlay;
  servo.noise_std /= 50.0, servo.best_rmse /= 50.0, servo.at_output = 50.0;
  const auto at_motor = score(servo, diagnosis_with(explained, {cause("backlash")}));
  EXPECT_NEAR(at_motor.after_over_noise, right.after_over_noise, 1e-12);
  EXPECT_NEAR(at_motor.gain_share, right.gain_share, 1e-12);
  EXPECT_TRUE(std::isnan(score(kNull, diagnosis_with(adequate, {})).after_over_noise));
  EXPECT_TRUE(std::isnan(score(kUnknown, diagnosis_with(unexplained, {})).after_over_noise));
}

TEST(ScoreOfAFailure, CountsNothingButItself) {
  const CaseScore failed = score_case(kPlay, nullptr);
  EXPECT_TRUE(failed.failed);
  EXPECT_EQ(failed.kind, CaseKind::single);
  EXPECT_FALSE(failed.detected || failed.first_right || failed.has_coordinate);
}

ScoredCase scored(const ConcealedAnswer& answer, const Diagnosis* diagnosis, double seconds = 1.0) {
  ScoredCase one;
  one.answer = answer;
  one.score = score_case(answer, diagnosis);
  one.seconds = seconds;
  return one;
}

TEST(ScoresOfATrial, AreTheCountersOfPracticeCases) {
  const auto null_right = diagnosis_with(adequate, {});
  const auto play_right = diagnosis_with(explained, {cause("backlash")}, {"torsion"});
  const auto scores =
      score_trial({scored(kNull, &null_right), scored(kNull, &play_right, 3.0),
                   scored(kPlay, &play_right), scored(kPlay, &null_right), scored(kPlay, nullptr),
                   scored(kPair, &play_right, 2.0), scored(kUnknown, &null_right)});
  const auto expect = [&scores](const char* name, int value) {
    EXPECT_EQ(scores.counter(name), value) << name;
  };
  expect("cases", 7);
  expect("failed", 1);
  expect("null", 2);
  expect("null_ok", 1);
  expect("single", 3);
  expect("single_top", 1);
  expect("single_exact", 1);
  expect("pair", 1);
  expect("pair_all", 0);
  expect("pair_one", 1);
  expect("unknown", 1);
  expect("unknown_ok", 0);
  expect("unknown_unnamed", 1);
  expect("false_names", 1);
  expect("named", 3);
  expect("coord", 4);
  expect("coord_ok", 2);
  EXPECT_EQ(scores.rate("false_name").count, 1);
  EXPECT_EQ(scores.rate("false_name").of, 6) << "of those diagnosed";
  EXPECT_EQ(scores.median("seconds_max"), 3.0);
  EXPECT_NEAR(scores.median("holdout_after_over_noise_median"), 1.2, 1e-12);
}

TEST(ScoresOfATrial, OfNoCasesAreNotNumbers) {
  const auto scores = score_trial({});
  EXPECT_TRUE(std::isnan(scores.median("seconds_max")));
  EXPECT_TRUE(std::isnan(scores.rate("null_ok").rate()));
}

TEST(Wilson, HasTheClosedFormsAtTheEnds) {
  // 0 of n: upper = z^2/(n + z^2); n of n is its mirror.
  constexpr double kSquare = 1.959963984540054 * 1.959963984540054;
  const Proportion none = proportion(0, 20);
  EXPECT_EQ(none.lower, 0.0);
  EXPECT_NEAR(none.upper, kSquare / (20.0 + kSquare), 1e-12);
  const Proportion all = proportion(20, 20);
  EXPECT_NEAR(all.lower, 20.0 / (20.0 + kSquare), 1e-12);
  EXPECT_EQ(all.upper, 1.0);
  EXPECT_EQ(proportion(0, 0).upper, 1.0);
}

TEST(Wilson, HasEndsThatTheScoreTestJustKeeps) {
  // (share - p)^2 n = z^2 p (1 - p) at either end.
  const Proportion p = proportion(3, 10);
  for (const double end : {p.lower, p.upper}) {
    EXPECT_NEAR(std::abs(0.3 - end) / std::sqrt(end * (1.0 - end) / 10.0), 1.959963984540054, 1e-9);
  }
  EXPECT_LT(p.lower, 0.3);
  EXPECT_GT(p.upper, 0.3);
}

TEST(ScoreOfAVariant, TakesTheNamesThatTheBenchSaysAreRight) {
  const auto odd = answer_with(Rig::free, {"variant:kinematic_order"});
  const auto right = score(odd, diagnosis_with(explained, {cause("kinematic_error")}));
  EXPECT_EQ(right.kind, CaseKind::single);
  EXPECT_TRUE(right.exact);
  EXPECT_EQ(right.first_name, "variant:kinematic_order");
  EXPECT_FALSE(score(odd, diagnosis_with(explained, {cause("encoder_eccentricity")})).exact);
  const auto resolver = answer_with(Rig::free, {"variant:resolver_error"});
  EXPECT_TRUE(score(resolver, diagnosis_with(explained, {cause("encoder_eccentricity")})).exact);
}

/// A burst from 4 s to 6 s of 20 s.
ConcealedAnswer burst() {
  ConcealedAnswer answer = answer_with(Rig::locked, {"incident:burst"});
  answer.effects[0].place = data::HiddenPlace{"slow", 4.0, 6.0, 20.0};
  return answer;
}

Diagnosis located(const std::string& recording, double from, double to) {
  Diagnosis diagnosis = diagnosis_with(unexplained, {}, {"window"});
  diagnosis.mismatch[0].recording = recording;
  diagnosis.mismatch[0].from_s = from;
  diagnosis.mismatch[0].to_s = to;
  return diagnosis;
}

TEST(ScoreOfAnIncident, WantsItsRecordingAndItsInterval) {
  const CaseScore right = score(burst(), located("slow", 4.5, 6.5));
  EXPECT_EQ(right.kind, CaseKind::incident);
  EXPECT_TRUE(right.incident_found && right.unknown_right);
  EXPECT_NEAR(right.overlap, 1.5 / 2.5, 1e-12) << "intersection over union";
  EXPECT_FALSE(score(burst(), located("fast", 4.5, 6.5)).incident_found);
  EXPECT_FALSE(score(burst(), located("slow", 0.0, 20.0)).incident_found)
      << "all of it is no place";
  EXPECT_FALSE(score(burst(), located("slow", 7.0, 8.0)).incident_found);
  Diagnosis blind = located("slow", 4.0, 6.0);
  blind.verdict = adequate;
  EXPECT_FALSE(score(burst(), blind).incident_found);
}

TEST(ScoreOfAnIncident, WidensWhatIsShorterThanAWindow) {
  ConcealedAnswer glitch = burst();
  glitch.effects[0].place = data::HiddenPlace{"slow", 4.0, 4.1, 20.0};
  EXPECT_NEAR(score(glitch, located("slow", 3.55, 4.55)).overlap, 1.0, 1e-12);
}

}  // namespace
}  // namespace flexspline::studies
