#include <set>

#include <gtest/gtest.h>

#include "flexspline/studies/plan.hpp"
#include "source_dir.hpp"
#include "study_file.hpp"

namespace flexspline::studies {
namespace {

StudyConfig load(const ScratchFolder& folder, const std::string& text) {
  const auto study = load_study(folder.write("study.toml", text));
  EXPECT_TRUE(study.has_value()) << (study ? "" : study.error().message());
  return study.value_or(StudyConfig{});
}

TEST(Plan, IsInputsTimesTheirEstimatorsTimesReplicates) {
  const ScratchFolder folder;
  const auto study = load(
      folder,
      kHead + "seed = 10\nreplicates = 3\n" + kGrid + kInput +
          "[[input]]\nid = \"h_even\"\ntruth = \"h_even\"\nholdout = \"point\"\n" + kEstimator +
          "[[estimator]]\nid = \"pooled\"\nmethod = \"midpoint_pooled\"\ntrain = \"point\"\n"
          "inputs = [\"h_even\"]\n");
  const auto plan = plan_study(study, "build");
  ASSERT_TRUE(plan.has_value());
  EXPECT_EQ(plan->inputs.size(), 2U);
  EXPECT_EQ(plan->size(), 9U);
  std::set<std::string> keys;
  std::set<std::string> hashes;
  for (std::size_t i = 0; i < plan->size(); ++i) {
    const CasePlan one = plan->at(i);
    keys.insert(one.key);
    hashes.insert(one.depends_on);
    EXPECT_EQ(one.seed, 10U + static_cast<unsigned>(one.replicate));
    EXPECT_EQ(one.depends_on.size(), 64U);
  }
  EXPECT_EQ(keys.size(), 9U);
  EXPECT_EQ(hashes.size(), 9U);
  EXPECT_TRUE(keys.contains("h_even--pooled--r2"));
  EXPECT_FALSE(keys.contains("unity--pooled--r0"));
}

TEST(Plan, HoldOutIsRecordedApartFromTraining) {
  const ScratchFolder folder;
  const auto study = load(folder, kHead + kGrid + kInput + kEstimator);
  const auto plan = plan_study(study, "build");
  ASSERT_TRUE(plan.has_value());
  EXPECT_EQ(plan->at(0).train, std::vector<std::string>{"a0.2000-f0.00500"});
  EXPECT_EQ(plan->at(0).holdout, std::vector<std::string>{"holdout/a0.2000-f0.00500"});
}

TEST(Plan, HashFollowsWhatTheResultDependsOnAndNothingElse) {
  const ScratchFolder folder;
  const auto hash = [&](const std::string& text, const std::string& build = "build") {
    const auto study = load(folder, text);
    const auto plan = plan_study(study, build);
    return plan ? plan->at(0).depends_on : std::string();
  };
  const std::string text = kHead + kGrid + kInput + kEstimator;
  const std::string base = hash(text);
  EXPECT_EQ(hash(kHead + "title = \"other words\"\nreplicates = 2\n" + kGrid + kInput + kEstimator),
            base);
  EXPECT_NE(hash(text, "other"), base);
  EXPECT_NE(hash(kHead + "seed = 2\n" + kGrid + kInput + kEstimator), base);
  EXPECT_NE(hash(kHead + "[bench]\ncycles = 6\n" + kGrid + kInput + kEstimator), base);
}

/// The studies that come with the program are valid and hold what their description promises.
TEST(Plan, PaperStudyCoversEveryTruth) {
  const auto study = load_study(std::string(FLEXSPLINE_SOURCE_DIR) + "/studies/paper.toml");
  ASSERT_TRUE(study.has_value()) << study.error().message();
  std::set<std::string> used;
  for (const InputConfig& input : study->inputs) used.insert(input.truth);
  for (const data::TruthRow& row : data::truths())
    EXPECT_TRUE(used.contains(std::string(row.id))) << row.id;
  EXPECT_TRUE(study->paper);
}

}  // namespace
}  // namespace flexspline::studies
