// The search anew in every outer fold, against the same recordings deleted by hand.
#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "diagnosis/frame/folds.hpp"
#include "diagnosis/names/judged_once.hpp"
#include "flexspline/studies/diagnosis_json.hpp"
#include "flexspline/studies/trial.hpp"
#include "judged_bench.hpp"

namespace flexspline::studies {
namespace {

/// Recordings of which rows are marked 1.
std::vector<std::string> ids_in(const Frame& frame, const Eigen::ArrayXd& rows) {
  std::vector<std::string> ids;
  for (const Segment& s : frame.segments) {
    if (rows.segment(s.first, s.count).sum() > 0.0) ids.push_back(s.id);
  }
  return ids;
}

TEST(NestedProof, PoolsWhatIsFoundWithEachFoldDeleted) {
  const auto frame = make_frame(judged_bench(), 16000);
  ASSERT_TRUE(frame) << frame.error().message();
  const auto folds = outer_folds(*frame);
  const Diagnosis nested = judged(judged_bench());
  ASSERT_EQ(nested.holdout.folds, static_cast<int>(folds.size()));
  ASSERT_FALSE(nested.causes.empty());
  double before = 0.0, after = 0.0, rows = 0.0, naming = 0.0;
  for (const OuterFold& fold : folds) {
    ASSERT_TRUE(fold.proves) << "nothing is marked";
    const auto ids = ids_in(*frame, fold.rows);
    const double count = (fold.rows * frame->usable).sum();
    const Diagnosis one = judged(judged_bench(), {.holdout = ids});
    before += count * std::pow(one.holdout.rmse_before, 2);
    after += count * std::pow(one.holdout.rmse_after, 2);
    rows += count;
    const auto rest = without(judged_bench(), ids);
    ASSERT_TRUE(rest) << rest.error().message();
    const auto found = names(judged(*rest, {.nested = false}));
    naming += static_cast<double>(std::ranges::count(found, nested.causes.front().effect));
  }
  EXPECT_NEAR(nested.holdout.rmse_before, std::sqrt(before / rows), 1e-9);
  EXPECT_NEAR(nested.holdout.rmse_after, std::sqrt(after / rows), 1e-9);
  EXPECT_DOUBLE_EQ(nested.causes.front().stability, naming / static_cast<double>(folds.size()));
  EXPECT_GE(nested.holdout.ratio, nested.holdout.ci95_lower);
  EXPECT_LE(nested.holdout.ratio, nested.holdout.ci95_upper);
}

TEST(NestedProof, OfMarkedRecordingsIsThatOfTheSameTakenAway) {
  RecordingSet set = judged_bench();
  const std::string id = set.recordings[1].id;
  set.recordings[1].split = Split::holdout;
  const Diagnosis marked = judged(set);
  const Diagnosis taken = judged(judged_bench(), {.holdout = {id}});
  EXPECT_EQ(marked.holdout.folds, 1);
  EXPECT_NEAR(marked.holdout.rmse_before, taken.holdout.rmse_before, 1e-9);
  EXPECT_NEAR(marked.holdout.rmse_after, taken.holdout.rmse_after, 1e-9);
}

TEST(NestedProof, QuickHasNoneAndSaysSo) {
  const Diagnosis quick = judged(judged_bench(), {.nested = false});
  EXPECT_FALSE(quick.holdout.nested);
  EXPECT_FALSE(quick.cross_validated);
  const auto json = to_json(quick);
  EXPECT_EQ(json["quick"], true);
  EXPECT_TRUE(json["causes"][0]["stability"].is_null());
}

TEST(NestedProof, OfAClearCauseTheAnswerIsThatOfQuickAndNotOfTheThreads) {
  const Diagnosis quick = judged(judged_bench(), {.nested = false});
  const Diagnosis one = judged(judged_bench(), {.threads = 1});
  const Diagnosis two = judged(judged_bench(), {.threads = 2});
  EXPECT_EQ(names(one), names(quick));
  ASSERT_TRUE(one.cross_validated);
  EXPECT_EQ(one.cross_validated->rmse_after, quick.holdout.rmse_after);
  EXPECT_EQ(one.holdout.rmse_after, two.holdout.rmse_after);
  EXPECT_EQ(one.causes.front().stability, two.causes.front().stability);
}

TEST(NestedProof, IsATrialsWhereItAsksForFolds) {
  const auto with = diagnose_as({{"folds", "outer"}}, 1)(judged_bench(), {});
  const auto without_folds = diagnose_as({}, 1)(judged_bench(), {});
  ASSERT_TRUE(with && without_folds);
  EXPECT_TRUE(with->holdout.nested);
  EXPECT_FALSE(with->quick);
  EXPECT_FALSE(without_folds->holdout.nested);
  EXPECT_TRUE(without_folds->quick);
}

}  // namespace
}  // namespace flexspline::studies
