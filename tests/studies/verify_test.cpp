#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "config/study_json.hpp"
#include "flexspline/core/write_file.hpp"
#include "flexspline/data/artefact.hpp"
#include "flexspline/studies/run.hpp"
#include "flexspline/studies/verify.hpp"
#include "stored.hpp"

namespace flexspline::studies {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr const char* kStudy = R"(schema = "flexspline-study/1"
name = "small"
seed = 3
[bench]
cycles = 3
samples_per_cycle = 100
torque_noise_white = { value = 0.5, unit = "%" }
[[grid]]
id = "loop"
loops = { values = [[0.2, 0.005]], units = ["deg", "Hz"] }
[[grid]]
id = "held"
loops = { values = [[0.1, 0.005]], units = ["deg", "Hz"] }
[[input]]
id = "unity"
truth = "unity"
holdout = "held"
[[estimator]]
id = "paper"
method = "midpoint_polynomial"
train = "loop"
)";

ordered_json estimate(double value, double std) {
  ordered_json parameter = {{"name", "a1"}, {"value", value}, {"std", std}};
  return {{"schema", "x/1"}, {"parameters", {parameter}}, {"seconds", 1.0}, {"sha256", "0"}};
}

TEST(CompareArtefacts, LeavesOutWallClockAndChecksum) {
  ordered_json other = estimate(2.0, 0.1);
  other["seconds"] = 7.0;
  other["sha256"] = "1";
  const ArtefactCheck check = compare_artefacts(estimate(2.0, 0.1), other, false);
  EXPECT_EQ(check.level, Agreement::bitwise);
  EXPECT_EQ(check.unequal, 0U);
}

TEST(CompareArtefacts, HoldsAParameterToAThousandthOfItsDeviation) {
  const auto level = [](double off, bool changed) {
    return compare_artefacts(estimate(2.0, 0.1), estimate(2.0 + off, 0.1), changed).level;
  };
  // Both deviations together are 0.1414: the tolerance is 1.414e-4 + 2e-6.
  EXPECT_EQ(level(1.4e-4, false), Agreement::numeric);
  EXPECT_EQ(level(1.5e-4, false), Agreement::differs);
  // Four of them at the statistical level, which needs a reason.
  EXPECT_EQ(level(0.5, true), Agreement::statistical);
  EXPECT_EQ(level(0.5, false), Agreement::differs);
  EXPECT_EQ(level(0.6, true), Agreement::differs);
}

TEST(CompareArtefacts, HoldsACurveToItsPeakAndASentenceToItsWords) {
  const ordered_json before = {{"motion", {0.0, 100.0}}, {"says", "0.331 Nm is left"}};
  ordered_json after = {{"motion", {9e-5, 100.0}}, {"says", "0.332 Nm is left"}};
  EXPECT_EQ(compare_artefacts(before, after, false).level, Agreement::numeric);
  after["says"] = "nothing is left";
  EXPECT_EQ(compare_artefacts(before, after, false).level, Agreement::differs);
}

TEST(CompareArtefacts, SeesThatANumberBecameNull) {
  const ordered_json before = {{"rmse", 0.3}}, after = {{"rmse", nullptr}};
  const ArtefactCheck check = compare_artefacts(before, after, true);
  EXPECT_EQ(check.level, Agreement::differs);
  ASSERT_EQ(check.worst.size(), 1U);
  EXPECT_EQ(check.worst.front().where, "rmse");
}

/// A study run into a folder of its own.
class VerifyFolders : public testing::Test {
 protected:
  VerifyFolders() {
    root_ = fs::path(testing::TempDir()) /
            (std::string("flexspline-verify-") +
             testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(root_);
  }
  ~VerifyFolders() override { fs::remove_all(root_); }

  fs::path run(const std::string& name, const StudyConfig& study, const std::string& build) {
    const auto plan = plan_study(study, build);
    EXPECT_TRUE(plan);
    RunSettings settings;
    settings.folder = root_ / name;
    settings.jobs = 1;
    settings.build_id = build;
    settings.versions = {{"commit", build}};
    EXPECT_TRUE(run_study(*plan, settings));
    return settings.folder;
  }

  StudyConfig study() {
    EXPECT_TRUE(write_file(root_ / "study.toml", kStudy));
    auto read = load_study(root_ / "study.toml");
    EXPECT_TRUE(read) << (read ? "" : read.error().message());
    return read.value_or(StudyConfig{});
  }

  fs::path root_;
};

TEST_F(VerifyFolders, FindsARunFromItsLockFileTheSameToTheLastBit) {
  const StudyConfig given = study();
  const fs::path folder = run("first", given, "b1");
  const auto locked = read_locked_study(folder / "study.lock.toml");
  ASSERT_TRUE(locked) << locked.error().message();
  EXPECT_EQ(to_json(*locked), to_json(given));
  const auto verification = verify_folders(folder, run("again", *locked, "b1"));
  ASSERT_TRUE(verification);
  EXPECT_EQ(verification->level, Agreement::bitwise) << verification->says;
  EXPECT_EQ(verification->artefacts.size(), 2U);
  EXPECT_TRUE(verification->changed.empty());
}

TEST_F(VerifyFolders, NamesSeedAndCodeThatChanged) {
  StudyConfig given = study();
  const fs::path folder = run("first", given, "b1");
  given.seed = 4;
  const auto verification = verify_folders(folder, run("again", given, "b2"));
  ASSERT_TRUE(verification);
  EXPECT_GE(verification->level, Agreement::statistical);
  const auto has = [&](const char* kind) {
    return std::ranges::count(verification->changed, kind, &Circumstance::kind) > 0;
  };
  EXPECT_TRUE(has("seed"));
  EXPECT_TRUE(has("code"));
  EXPECT_FALSE(has("library"));
  EXPECT_FALSE(has("data"));
}

TEST_F(VerifyFolders, BlamesNobodyForANumberThatWasChangedByHand) {
  const fs::path folder = run("first", study(), "b1");
  const fs::path again = run("again", study(), "b1");
  auto artefact = stored_artefact(folder, "unity--paper--r0");
  artefact["recordings"][1]["rmse"] = 1e-9;
  replace_case(folder, "unity--paper--r0", artefact);
  const auto verification = verify_folders(folder, again);
  ASSERT_TRUE(verification);
  EXPECT_EQ(verification->level, Agreement::differs);
  EXPECT_FALSE(verification->holds());
  EXPECT_TRUE(verification->changed.empty());
  EXPECT_NE(verification->says.find("changed or lost after it was written"), std::string::npos);
}

TEST_F(VerifyFolders, TellsADamagedArtefactFromAMissingOne) {
  const fs::path folder = run("first", study(), "b1");
  const fs::path again = run("again", study(), "b1");
  ASSERT_TRUE(write_file(folder / "inputs" / "unity.json", "{\"schema\": \"flexspline-input/1\"}"));
  remove_case(folder, "unity--paper--r0");
  const auto verification = verify_folders(folder, again);
  ASSERT_TRUE(verification);
  ASSERT_EQ(verification->artefacts.size(), 2U);
  EXPECT_EQ(verification->artefacts[0].level, Agreement::missing);
  EXPECT_EQ(verification->artefacts[1].level, Agreement::differs);
  EXPECT_NE(verification->artefacts[1].reason.find("checksum"), std::string::npos);
}

TEST_F(VerifyFolders, RefusesAFolderWithoutArtefacts) {
  const auto verification = verify_folders(root_ / "nowhere", root_);
  ASSERT_FALSE(verification);
  EXPECT_EQ(verification.error().code, ErrorCode::input_missing);
}

}  // namespace
}  // namespace flexspline::studies
