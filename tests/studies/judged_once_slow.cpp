#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "flexspline/studies/diagnosis_json.hpp"
#include "judged_bench.hpp"

namespace flexspline::studies {
namespace {

TEST(JudgedOnce, RecordingsTakenAwayAreSaidAndTheOthersCrossValidated) {
  const std::string id = judged_bench().recordings[1].id;
  const Diagnosis d = judged(judged_bench(), {.holdout = {id}});
  EXPECT_TRUE(d.holdout.nested);
  EXPECT_EQ(d.holdout.recordings, std::vector<std::string>{id});
  ASSERT_TRUE(d.cross_validated);
  EXPECT_FALSE(d.cross_validated->nested);
  EXPECT_LT(d.holdout.rmse_after, d.holdout.rmse_before);
  EXPECT_LT(d.holdout.over_noise(), 1.5) << "what was found holds there, too";
  EXPECT_GE(d.holdout.ratio, d.holdout.ci95_lower);
  EXPECT_LE(d.holdout.ratio, d.holdout.ci95_upper);
  const auto json = to_json(d);
  EXPECT_EQ(json["holdout"]["nested"], true);
  EXPECT_EQ(json["cross_validated"]["nested"], false);
  const auto shown = std::ranges::find(d.series, id, &DiagnosedSeries::recording);
  ASSERT_NE(shown, d.series.end());
  EXPECT_EQ(shown->split, Split::holdout);
}

// The proof of a search that never saw them: what they hold changes nothing of what is found.
TEST(JudgedOnce, WhatIsTakenAwayHasNoSayInWhatIsFound) {
  RecordingSet other = judged_bench();
  Recording& held = other.recordings[1];
  for (double& tau : held.channels.at(Quantity::transmitted_torque)) tau += 0.2;
  const Diagnosis a = judged(judged_bench(), {.holdout = {held.id}});
  const Diagnosis b = judged(other, {.holdout = {held.id}});
  EXPECT_EQ(names(a), names(b));
  ASSERT_EQ(a.causes.size(), b.causes.size());
  for (std::size_t k = 0; k < a.causes.size(); ++k) {
    EXPECT_EQ(a.causes[k].size, b.causes[k].size);
    EXPECT_EQ(a.causes[k].evidence.delta_bic, b.causes[k].evidence.delta_bic);
  }
  EXPECT_EQ(a.cross_validated->rmse_after, b.cross_validated->rmse_after);
  EXPECT_GT(b.holdout.rmse_after, a.holdout.rmse_after) << "only the judgement is another";
}

TEST(JudgedOnce, RefusesWhatIsNotThereAndEverything) {
  const auto unknown = diagnose(judged_bench(), {}, {.holdout = {"nothing"}});
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().code, ErrorCode::usage);
  EXPECT_NE(unknown.error().message().find("nothing"), std::string::npos);
  std::vector<std::string> all;
  for (const Recording& recording : judged_bench().recordings) all.push_back(recording.id);
  const auto everything = diagnose(judged_bench(), {}, {.holdout = all});
  ASSERT_FALSE(everything);
  EXPECT_EQ(everything.error().code, ErrorCode::usage);
}

}  // namespace
}  // namespace flexspline::studies
