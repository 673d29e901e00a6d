// What recordings held out do not confirm is withdrawn; what they confirm stays.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "accepted_ids.hpp"
#include "diagnosis/names/confirm.hpp"
#include "searched_drive.hpp"

namespace flexspline::studies {
namespace {

constexpr Eigen::Index kRows = 16000;

class Confirm : public SearchedDrive {
 protected:
  // As if the search had taken what is not there.
  void accept_the_best() {
    auto trials = try_causes(frame_, s_.baseline);
    Accepted best;
    best.trial = trials.front();
    s_.final.fit = best.trial.fit;
    s_.accepted = {std::move(best)};
    ASSERT_TRUE(fit_all(frame_, s_.final, 0));
  }
};

TEST_F(Confirm, KeepsWhatHoldsOnRecordingsHeldOut) {
  search_hidden(kRows);
  const auto proof = confirm(frame_, limits_, s_);
  ASSERT_TRUE(proof) << proof.error().message();
  EXPECT_THAT(ids(s_.accepted), testing::ElementsAre(kHidden));
  EXPECT_LT(proof->holdout.ratio, 0.8);
  EXPECT_TRUE(s_.withdrawn.empty());
}

TEST_F(Confirm, WithdrawsWhatDoesNot) {
  search({}, kRows);
  ASSERT_TRUE(s_.accepted.empty());
  accept_the_best();
  const auto proof = confirm(frame_, limits_, s_);
  ASSERT_TRUE(proof) << proof.error().message();
  EXPECT_TRUE(s_.accepted.empty());
  ASSERT_THAT(ids(s_.withdrawn), testing::SizeIs(1));
  EXPECT_THAT(std::string(s_.withdrawn.front().withdrawn_because),
              testing::HasSubstr("recordings held out"));
}

}  // namespace
}  // namespace flexspline::studies
