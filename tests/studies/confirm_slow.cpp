// What recordings held out do not confirm is withdrawn; what they confirm stays.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "accepted_ids.hpp"
#include "diagnosis/confirm.hpp"
#include "drive_frame.hpp"

namespace flexspline::studies {
namespace {

constexpr std::string_view kHidden = "presliding_hysteresis";
constexpr Eigen::Index kRows = 16000;

class Confirm : public testing::Test {
 protected:
  void SetUp() override {
    const auto hidden = drawn_case(Rig::locked, 201, {{std::string(kHidden), 0.06}});
    auto made = make_frame(hidden.recordings, kRows);
    ASSERT_TRUE(made) << made.error().message();
    frame_ = std::move(*made);
    auto selection = select_causes(frame_, limits_, {});
    ASSERT_TRUE(selection) << selection.error().message();
    s_ = std::move(*selection);
    ASSERT_TRUE(settle_baseline(frame_, s_));
    ASSERT_THAT(ids(s_.accepted), testing::ElementsAre(kHidden));
  }

  // As if the search had taken another cause: the least of those that were tried.
  void accept_the_least() {
    auto trials = try_causes(frame_, s_.baseline);
    std::erase_if(trials, [](const Trial& t) { return t.cause.row == nullptr; });
    Accepted& a = s_.accepted.front();
    a.trial = *std::ranges::min_element(trials, {}, &Trial::gain);
    ASSERT_NE(a.trial.cause.row->id, kHidden);
    a.rivals.clear();
    s_.final.fit = a.trial.fit;
    ASSERT_TRUE(fit_all(frame_, s_.final, 0));
  }

  Frame frame_;
  Limits limits_;
  Selection s_;
};

TEST_F(Confirm, KeepsWhatHoldsOnRecordingsHeldOut) {
  const auto proof = confirm(frame_, limits_, s_);
  ASSERT_TRUE(proof) << proof.error().message();
  EXPECT_THAT(ids(s_.accepted), testing::ElementsAre(kHidden));
  EXPECT_LT(proof->holdout.ratio, 0.8);
  EXPECT_TRUE(s_.withdrawn.empty());
}

TEST_F(Confirm, WithdrawsWhatDoesNot) {
  accept_the_least();
  const auto proof = confirm(frame_, limits_, s_);
  ASSERT_TRUE(proof) << proof.error().message();
  EXPECT_TRUE(s_.accepted.empty());
  ASSERT_THAT(ids(s_.withdrawn), testing::SizeIs(1));
  EXPECT_THAT(std::string(s_.withdrawn.front().withdrawn_because),
              testing::HasSubstr("recordings held out"));
}

}  // namespace
}  // namespace flexspline::studies
