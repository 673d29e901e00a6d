#include <gtest/gtest.h>

#include "decision/proof.hpp"
#include "diagnosis/folds.hpp"
#include "drive_frame.hpp"
#include "flexspline/studies/decision.hpp"

namespace flexspline::studies {
namespace {

Diagnosis decided(const RecordingSet& set, bool proves) {
  auto result = diagnose_by_evidence(set, {}, {.threads = 2, .proves = proves, .model = proves});
  EXPECT_TRUE(result.has_value()) << (result ? "" : result.error().message());
  return result ? *std::move(result) : Diagnosis{};
}

TEST(DiagnoseByEvidence, FindsNothingWhereNothingWasLeftOut) {
  for (const auto& [rig, seed] : {std::pair{Rig::locked, 101}, std::pair{Rig::specimen, 104}}) {
    const Diagnosis d =
        decided(drawn_case(rig, static_cast<std::uint64_t>(seed), {}).recordings, false);
    EXPECT_EQ(d.verdict, Verdict::adequate) << name_of(rig) << ": " << d.says;
    EXPECT_TRUE(d.causes.empty());
  }
}

TEST(DiagnoseByEvidence, NamesAndProvesWhatWasLeftOut) {
  const auto hidden = drawn_case(Rig::locked, 201, {{"inertia_torque", 0.06}});
  const Diagnosis d = decided(hidden.recordings, true);
  ASSERT_FALSE(d.causes.empty()) << d.says;
  EXPECT_EQ(d.causes.front().effect, "inertia_torque");
  EXPECT_EQ(d.causes.size(), 1U);
  EXPECT_EQ(d.verdict, Verdict::explained) << d.says;
  EXPECT_NEAR(d.causes.front().size_fraction, hidden.answer.effects.front().size_fraction, 0.02);
  EXPECT_LT(d.holdout.ratio, 1.0);
  EXPECT_LT(d.holdout.rmse_after, 1.15 * hidden.answer.noise_std);
  EXPECT_TRUE(d.model.has_value());
}

TEST(DiagnoseByEvidence, AFloorOfInterestAboveTheEffectLeavesItUnnamed) {
  const auto hidden = drawn_case(Rig::locked, 201, {{"inertia_torque", 0.03}});
  auto result = diagnose_by_evidence(
      hidden.recordings, {}, {.interest = 0.2, .threads = 2, .proves = false, .model = false});
  ASSERT_TRUE(result.has_value());
  EXPECT_TRUE(result->causes.empty());
  EXPECT_EQ(result->verdict, Verdict::adequate) << result->says;
}

TEST(DiagnoseByEvidence, RefusesWhatDoesNotMove) {
  RecordingSet set = drawn_case(Rig::locked, 101, {}).recordings;
  for (Recording& recording : set.recordings) {
    for (auto& [quantity, values] : recording.channels) std::ranges::fill(values, 0.0);
  }
  EXPECT_FALSE(diagnose_by_evidence(set).has_value());
}

// What a fold holds out is not there, whole recordings or their ends.
TEST(OuterFolds, LeaveNoRowOfWhatTheyHoldOut) {
  const RecordingSet set = drawn_case(Rig::locked, 101, {}).recordings;
  const auto frame = make_frame(set, 16000);
  ASSERT_TRUE(frame.has_value());
  for (const Eigen::ArrayXd& fold : folds_of(*frame)) {
    const RecordingSet rest = without_rows(set, *frame, fold);
    ASSERT_LT(rest.recordings.size(), set.recordings.size());
    for (const Recording& kept : rest.recordings) {
      const auto s = std::ranges::find(frame->segments, kept.id, &Segment::id);
      EXPECT_EQ(fold.segment(s->first, s->count).sum(), 0.0) << kept.id;
    }
  }
  Eigen::ArrayXd end = Eigen::ArrayXd::Zero(frame->rows());
  const Segment& first = frame->segments.front();
  end.segment(first.first + first.count - 50, 50).setOnes();
  const RecordingSet cut = without_rows(set, *frame, end);
  const auto same = std::ranges::find(cut.recordings, first.id, &Recording::id);
  ASSERT_NE(same, cut.recordings.end());
  EXPECT_EQ(static_cast<Eigen::Index>(same->time.size()), first.count - 50);
}

}  // namespace
}  // namespace flexspline::studies
