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
  void accept_beside(const Trial& trial) {
    auto fit = extended(frame_, s_.final, trial.cause, 8);
    ASSERT_TRUE(fit) << fit.error().message();
    s_.final.fit = std::move(*fit);
    Accepted accepted;
    accepted.trial = trial;
    s_.accepted.push_back(std::move(accepted));
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

// Of two that are not there either may be missed beside the other, and both are not.
TEST_F(Confirm, LetsNoCauseHelpByMoreThanAllDo) {
  search({}, kRows);
  const auto trials = try_causes(frame_, s_.baseline);
  int missed = 0;
  for (std::size_t i = 1; i < 8; ++i) {
    accept_the_best();
    accept_beside(trials[i]);
    const auto proof = prove(frame_, s_, 0);
    ASSERT_TRUE(proof) << proof.error().message();
    for (const CauseProof& cause : proof->causes) {
      const double all = cause.name.over_noise / cause.name.before_over_noise;
      EXPECT_GE(cause.name.ratio, all * (1.0 - 1e-12));
      if (all >= 1.0) EXPECT_LE(cause.gain, 0.0);
      if (cause.name.ratio < all * (1.0 + 1e-12)) ++missed;
    }
  }
  EXPECT_GT(missed, 0) << "one has to seem to help by more beside the other";
}

}  // namespace
}  // namespace flexspline::studies
