#include <algorithm>
#include <filesystem>
#include <numbers>

#include <gmock/gmock.h>

#include "conceal/generator.hpp"
#include "conceal/run_program.hpp"
#include "flexspline/data/splice.hpp"
#include "source_dir.hpp"
#include "study_file.hpp"
#include "trial_fixture.hpp"

namespace flexspline::studies {
namespace {

std::filesystem::path script() {
  return std::filesystem::path(FLEXSPLINE_SOURCE_DIR) / "data" / "bench" / "mujoco" / "make.mjs";
}

ConcealPlan mujoco_plan(Rig rig, std::vector<data::HiddenEffect> effects) {
  ConcealPlan plan;
  plan.generator = "mujoco";
  plan.source = script();
  plan.rig = rig;
  plan.seed = 12;
  plan.effects = std::move(effects);
  return plan;
}

TEST(RunProgram, GivesWhatItWroteAndTellsWhyItFailed) {
  EXPECT_EQ(run_program({"printf", "a b"}).value(), "a b");
  const auto absent = run_program({"no-such-program-here"});
  ASSERT_FALSE(absent);
  EXPECT_EQ(absent.error().code, ErrorCode::input_missing);
  const auto failed = run_program({"sh", "-c", "echo 'Error: of its own' >&2; exit 3"});
  ASSERT_FALSE(failed);
  EXPECT_THAT(failed.error().message(), testing::HasSubstr("Error: of its own"));
}

TEST(Generators, SayWhatIsMissing) {
  ConcealPlan plan = mujoco_plan(Rig::free, {});
  plan.source = "/nowhere/make.mjs";
  const auto none = conceal(plan);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::input_missing);
  plan.generator = "splice";
  EXPECT_FALSE(conceal(plan));
  plan.generator = "nothing";
  EXPECT_EQ(conceal(plan).error().code, ErrorCode::usage);
}

class Mujoco : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(script().parent_path() / "node_modules" / "@mujoco")) {
      GTEST_SKIP() << "npm ci --prefix data/bench/mujoco installs what this needs";
    }
  }
};

TEST_F(Mujoco, IsAPureFunctionOfTheSeed) {
  const auto one = conceal(mujoco_plan(Rig::servo, {{"motor_torque_offset", 0.05}}));
  ASSERT_TRUE(one) << one.error().message();
  const auto again = conceal(mujoco_plan(Rig::servo, {{"motor_torque_offset", 0.05}}));
  EXPECT_EQ(one->recordings.sha256, again->recordings.sha256);
  EXPECT_EQ(one->answer.effects.at(0).id, "motor_torque_offset");
  EXPECT_EQ(one->answer.generator, "mujoco");
}

// An offset of the motor's torque is in what the loop asks for: the mean of motor torque less the
// mean without it, over whole cycles.
TEST_F(Mujoco, ShowsAnOffsetAsWhatItIs) {
  const auto with = conceal(mujoco_plan(Rig::free, {{"motor_torque_offset", 0.10}})).value();
  const auto without = conceal(mujoco_plan(Rig::free, {})).value();
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < with.recordings.recordings.size(); ++i) {
    const auto& a = with.recordings.recordings[i].channels.at(Quantity::motor_torque);
    const auto& b = without.recordings.recordings[i].channels.at(Quantity::motor_torque);
    for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] - b[k];
    count += a.size();
  }
  const double offset = with.answer.effects.at(0).parameters.at(0).value;
  EXPECT_NEAR(sum / static_cast<double>(count) / offset, 1.0, 0.1);
}

/// The part of the torque that goes with the angle, over the last cycle: -J w^2 where the load
/// swings at w, whatever its drag, which goes with the speed.
double in_phase(const Recording& r) {
  const auto& angle = r.channels.at(Quantity::load_angle);
  const auto& torque = r.channels.at(Quantity::transmitted_torque);
  const double from = r.time.back() - 1.0 / *r.frequency_hz;
  double product = 0.0;
  double square = 0.0;
  for (std::size_t k = 0; k < r.time.size(); ++k) {
    if (r.time[k] <= from) continue;
    product += torque[k] * angle[k];
    square += angle[k] * angle[k];
  }
  return product / square;
}

TEST_F(Mujoco, SwingsTheLoadByNewtonsLaw) {
  const auto made = conceal(mujoco_plan(Rig::free, {})).value();
  const double inertia = made.recordings.constants.at("load_inertia_kgm2");
  for (const Recording& r : made.recordings.recordings) {
    if (r.excitation != "sine") continue;
    const double rate = 2.0 * std::numbers::pi * *r.frequency_hz;
    EXPECT_NEAR(-in_phase(r) / (inertia * rate * rate), 1.0, 0.04) << r.id;
  }
}

TEST(ScoresOfSplices, AreAgainstTheSameRecordingsAsTheyAre) {
  const auto made = [](const std::string& change, std::vector<std::string> effects,
                       std::vector<std::string> named, double size = 0.03) {
    ScoredCase one;
    one.answer = answer_with(Rig::specimen, effects);
    one.answer.generator = "splice";
    one.answer.source = "gear";
    one.answer.change = change;
    for (auto& effect : one.answer.effects) effect.size_fraction = size;
    std::vector<Cause> causes;
    for (const std::string& name : named) causes.push_back(cause(name));
    const Diagnosis diagnosis =
        diagnosis_with(named.empty() ? Verdict::adequate : Verdict::explained, causes);
    one.named = std::move(named);
    one.verdict = name_of(diagnosis.verdict);
    one.score = score_case(one.answer, &diagnosis);
    return one;
  };
  auto one_loop = made("one_left_out", {}, {});
  one_loop.verdict = name_of(Verdict::undecided);
  const auto scores =
      splice_scores({made("none", {}, {"backlash"}), one_loop, made("mirrored", {}, {"backlash"}),
                     made("first_70", {}, {"backlash", "sensor_delay"}),
                     made("every_second", {}, {}), made("none", {}, {"backlash"}),
                     made("none", {"stribeck_friction"}, {"backlash", "stribeck_friction"}),
                     made("none", {"inertia_torque"}, {"backlash"}),
                     made("none", {"inertia_torque"}, {"inertia_torque"}, 0.1),
                     made("none", {"backlash"}, {"backlash"}, 0.1)});
  EXPECT_EQ(scores.changed, 4) << "the same recordings once more are no change";
  EXPECT_EQ(scores.undecided, 1);
  EXPECT_EQ(scores.same_verdict.count, 2);
  EXPECT_NEAR(scores.names_shared, (1.0 + 0.5 + 0.0 + 0.0) / 4.0, 1e-12);
  EXPECT_NEAR(scores.names_shared_decided, (1.0 + 0.5 + 0.0) / 3.0, 1e-12);
  EXPECT_EQ(scores.found_small.count, 1);
  EXPECT_EQ(scores.found_small.of, 2);
  EXPECT_EQ(scores.found_large.count, 1);
  EXPECT_EQ(scores.found_large.of, 1) << "what the recordings show anyway does not count";
}

ScoredCase named_with(double probability, bool right) {
  ScoredCase one;
  one.score.names = {{"backlash", right, probability}};
  return one;
}

TEST(Reliability, CountsRightNamesByPrintedProbability) {
  const auto bins = reliability_of({named_with(0.55, false), named_with(0.92, true),
                                    named_with(0.94, false), named_with(1.0, true),
                                    named_with(0.995, true), named_with(kNotComputed, true)});
  ASSERT_EQ(bins.size(), 3U);
  EXPECT_EQ(bins[0].right.of, 1);
  EXPECT_NEAR(bins[1].mean_probability, 0.93, 1e-12);
  EXPECT_EQ(bins[1].right.count, 1);
  EXPECT_EQ(bins[2].right.of, 2) << "1 is in the last bin";
}

TEST(Coverage, HoldsIntervalsAgainstParametersOfTheSameNameAndUnit) {
  ConcealedAnswer truth = answer_with(Rig::free, {"inertia_torque"});
  truth.effects[0].parameters = {{"inertia", -0.30, "kg m2"}};
  Cause found = cause("inertia_torque");
  found.parameters.resize(2);
  found.parameters[0].name = "inertia";
  found.parameters[0].unit = "kg m2";
  found.parameters[0].value = 0.32;
  found.parameters[0].std = 0.02;
  found.parameters[0].ci95_lower = 0.28;
  found.parameters[0].ci95_upper = 0.36;
  found.parameters[1].name = "other";
  const Diagnosis diagnosis = diagnosis_with(Verdict::explained, {found});
  ScoredCase one;
  one.score = score_case(truth, &diagnosis);
  ASSERT_EQ(one.score.intervals.size(), 1U);
  EXPECT_TRUE(one.score.intervals[0].covers()) << "the sign is each formula's own";
  one.score.intervals[0].truth = 0.4;
  const auto rows = coverage_of({one});
  EXPECT_EQ(rows.at(0).first, "all");
  EXPECT_EQ(rows.at(0).second.count, 0);
}

TEST(PlanOfATrial, GivesGeneratorsTheirTurns) {
  TrialConfig trial;
  trial.rigs = {Rig::free};
  trial.cases = 40;
  trial.generators = {"bench", "splice"};
  trial.spliced_sets = {"/nowhere/a", "/nowhere/b"};
  trial.draw = {.none = 1, .one = 1, .two = 0, .unknown = 0, .disturbed = 0.5, .effects = {}};
  const auto cases = plan_trial(trial);
  int disturbed = 0;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    EXPECT_EQ(cases[k].plan.generator, k % 2 == 0 ? "bench" : "splice");
    disturbed += cases[k].plan.disturbances.empty() ? 0 : 1;
  }
  EXPECT_NEAR(disturbed, 10, 1);
  EXPECT_EQ(cases[1].plan.source, "/nowhere/a");
  EXPECT_EQ(cases[3].plan.source, "/nowhere/b");
  EXPECT_EQ(cases[1].plan.change, "none");
  EXPECT_EQ(cases[5].plan.change, data::splice_changes()[1]);
}

}  // namespace
}  // namespace flexspline::studies
