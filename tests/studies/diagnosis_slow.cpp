#include <array>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "diagnosis_checks.hpp"
#include "drive_frame.hpp"
#include "flexspline/data/dataset.hpp"
#include "source_dir.hpp"

namespace flexspline::studies {
namespace {

TEST(DiagnoseSlow, SaysNothingWasLeftOutWhereNothingWas) {
  for (const Bench& bench : {Bench{Rig::locked, 102, ""}, Bench{Rig::specimen, 105, ""},
                             Bench{Rig::free, 106, ""}, Bench{Rig::free, 107, ""}}) {
    expect_nothing(bench);
  }
}

class DiagnoseFree : public testing::TestWithParam<Bench> {};

TEST_P(DiagnoseFree, EffectIsNamedFirstLocatedAndProved) { expect_found(GetParam()); }

INSTANTIATE_TEST_SUITE_P(AtSixPercent, DiagnoseFree,
                         testing::Values(Bench{Rig::free, 204, "load_dependent_friction"},
                                         Bench{Rig::free, 205, "stribeck_friction"},
                                         Bench{Rig::free, 207, "kinematic_error"}),
                         [](const auto& tested) { return tested.param.effect; });

TEST(DiagnoseSlow, NeverNamesWhatIsInNoCatalogue) {
  for (const Bench& bench :
       {Bench{Rig::locked, 301, "unknown:cross"}, Bench{Rig::locked, 302, "unknown:cross"},
        Bench{Rig::free, 303, "unknown:order"}}) {
    expect_no_name(bench);
  }
}

// Off while a remainder that the whole misfit tells, and no coordinate, has no place.
TEST(DiagnoseSlow, SaysWhereWhatHasNoNameIs) {
  for (const Bench& bench :
       {Bench{Rig::locked, 301, "unknown:cross"}, Bench{Rig::locked, 302, "unknown:cross"}}) {
    EXPECT_FALSE(diagnosed(bench.make().recordings).mismatch.empty()) << bench.words();
  }
}

TEST(DiagnoseSlow, NamesAndOrderSayNothingOnTheFreeRig) {
  RecordingSet set = Bench{Rig::free, 206, "gravity_load"}.make().recordings;
  const Said plain(diagnosed(set));
  rename(set);
  std::ranges::rotate(set.recordings, set.recordings.begin() + 3);
  expect_same(plain, Said(diagnosed(set)), 1e-6);
}

// Its gap closes so abruptly that one motion of the drive would take minutes to simulate; the whole
// answer takes five seconds.
TEST(DiagnoseSlow, AStiffGapDoesNotHoldUpWhatToRecordNext) {
  const Diagnosis d =
      diagnosed(drawn_case(Rig::free, 5388980950441753, {{"backlash", 0.09802}}).recordings);
  ASSERT_FALSE(d.causes.empty());
  EXPECT_EQ(d.causes.front().effect, "backlash");
  EXPECT_TRUE(d.next_experiment.has_value());
  EXPECT_LT(d.seconds, 90.0);
}

// The last bit of every value, as other units change it.
TEST(DiagnoseSlow, RoundingSaysNothing) {
  RecordingSet set = Bench{Rig::locked, 201, "inertia_torque"}.make().recordings;
  const Said plain(diagnosed(set));
  for (Recording& recording : set.recordings) {
    for (auto& [quantity, values] : recording.channels) {
      for (double& value : values) value = value / 57.29577951308232 * 57.29577951308232;
    }
  }
  expect_same(plain, Said(diagnosed(set)), 1e-3);
}

/// Practice cases beside the sources: what each hides, by the answers that lie there.
class DiagnosePractice : public testing::Test {
 protected:
  void SetUp() override {
    if (!exists(folder_ / "answers.json")) GTEST_SKIP() << folder_ << " is not here";
    answers_ = nlohmann::json::parse(std::ifstream(folder_ / "answers.json"));
  }
  const std::filesystem::path folder_ =
      std::filesystem::path(FLEXSPLINE_SOURCE_DIR) / ".." / "shared" / "practice";
  nlohmann::json answers_;
};

enum class Hidden { nothing, single, unknown, pair };

Hidden hidden(const std::vector<std::string>& effects) {
  if (effects.empty()) return Hidden::nothing;
  if (effects.front().starts_with("unknown:")) return Hidden::unknown;
  return effects.size() == 1 ? Hidden::single : Hidden::pair;
}

TEST_F(DiagnosePractice, NullsAreAdequateSinglesNamedFirstUnknownsNotNamed) {
  int singles = 0;
  int first = 0;
  std::array<int, 4> seen{};
  for (const auto& [key, answer] : answers_.items()) {
    const auto set = data::load_dataset(folder_ / "cases" / key);
    ASSERT_TRUE(set.has_value()) << set.error().message();
    const auto effects = answer.at("effects").get<std::vector<std::string>>();
    const Diagnosis d = diagnosed(*set);
    const Hidden kind = hidden(effects);
    ++seen.at(static_cast<std::size_t>(kind));
    const bool nameless = kind == Hidden::nothing || kind == Hidden::unknown;
    EXPECT_TRUE(!nameless || d.causes.empty()) << key;
    EXPECT_TRUE(!nameless || (d.verdict == Verdict::adequate) == (kind == Hidden::nothing)) << key;
    if (kind != Hidden::single) continue;
    ++singles;
    const bool right = !d.causes.empty() &&
                       (d.causes.front().effect == effects.front() ||
                        std::ranges::count(d.causes.front().alternatives, effects.front()) > 0);
    first += right ? 1 : 0;
    if (!right) std::printf("%s: %s not named first\n", key.c_str(), effects.front().c_str());
  }
  EXPECT_GE(first, 0.9 * singles);
  EXPECT_GT(seen[0], 0);
  EXPECT_GT(singles, 0);
}

}  // namespace
}  // namespace flexspline::studies
