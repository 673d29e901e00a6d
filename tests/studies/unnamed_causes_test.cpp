// Causes whose names are improbable: in the model without them where something is left and
// recordings held out confirm them.
#include "diagnosis/unnamed_causes.hpp"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnosis/confirm.hpp"
#include "drive_frame.hpp"

namespace flexspline::studies {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::string_view kHidden = "presliding_hysteresis";
constexpr Eigen::Index kRows = 4000;

std::vector<std::string_view> ids(const std::vector<Accepted>& accepted) {
  std::vector<std::string_view> list;
  for (const Accepted& a : accepted) list.push_back(a.trial.cause.row->id);
  return list;
}

class UnnamedCauses : public testing::Test {
 protected:
  void SetUp() override {
    const auto hidden = drawn_case(Rig::locked, 201, {{std::string(kHidden), 0.06}});
    auto made = make_frame(hidden.recordings, kRows);
    ASSERT_TRUE(made) << made.error().message();
    frame_ = std::move(*made);
    auto selection = select_causes(frame_, limits_, {});
    ASSERT_TRUE(selection) << selection.error().message();
    whole_ = std::move(*selection);
    ASSERT_TRUE(settle_baseline(frame_, whole_));
    ASSERT_THAT(ids(whole_.accepted), ElementsAre(kHidden));
    improbable_ = {whole_.accepted.front()};
    without_ = whole_;
    ASSERT_TRUE(leave_out(frame_, without_, 0, "it is more likely wrong than right"));
    without_.withdrawn.clear();
    locate_misfit(frame_, limits_, without_);
  }

  // Puts causes back into a selection as confirm() does.
  Proof put_back(Selection& s, std::vector<Accepted> improbable) const {
    auto named = prove(frame_, s, 0);
    EXPECT_TRUE(named);
    auto proof = with_unnamed(frame_, limits_, std::move(improbable), std::move(*named), s);
    EXPECT_TRUE(proof) << proof.error().message();
    return std::move(*proof);
  }

  // Of all others that are no friction the one that gains least on the baseline.
  std::vector<Accepted> least_of_all() const {
    auto trials = try_causes(frame_, whole_.baseline);
    std::erase_if(trials, [](const Trial& t) {
      return t.cause.row == nullptr || t.cause.row->of_baseline() || t.cause.form->friction;
    });
    Accepted least = whole_.accepted.front();
    least.trial = *std::ranges::min_element(trials, {}, &Trial::gain);
    return {least};
  }

  Frame frame_;
  Limits limits_;
  Selection whole_, without_;
  std::vector<Accepted> improbable_;
};

TEST_F(UnnamedCauses, PredictAsWellAsNamedOnes) {
  Selection named = whole_, s = without_;
  const auto proof = put_back(s, improbable_);
  EXPECT_THAT(ids(s.accepted), IsEmpty());
  EXPECT_THAT(ids(s.unnamed), ElementsAre(kHidden));
  EXPECT_THAT(ids(s.withdrawn), IsEmpty());
  EXPECT_TRUE(proof.causes.empty()) << "a proof is of names";
  const auto as_named = prove(frame_, named, 0);
  ASSERT_TRUE(as_named);
  EXPECT_LT(as_named->holdout.ratio, 0.8);
  EXPECT_NEAR(proof.holdout.rmse_after, as_named->holdout.rmse_after,
              0.02 * as_named->holdout.rmse_after);
  EXPECT_NEAR(proof.holdout.rmse_before, as_named->holdout.rmse_before,
              0.01 * as_named->holdout.rmse_before);
}

TEST_F(UnnamedCauses, ThatHeldOutRecordingsDoNotConfirmStayOut) {
  Selection s = without_;
  const auto proof = put_back(s, least_of_all());
  EXPECT_THAT(ids(s.unnamed), IsEmpty());
  EXPECT_THAT(ids(s.withdrawn), testing::SizeIs(1));
  EXPECT_EQ(s.final.fit.model.causes.size(), without_.final.fit.model.causes.size());
  EXPECT_NEAR(proof.holdout.ratio, 1.0, 1e-3);
}

TEST_F(UnnamedCauses, AreNotNeededWhereNothingIsLeft) {
  Selection s = whole_;
  locate_misfit(frame_, limits_, s);
  put_back(s, least_of_all());
  EXPECT_THAT(ids(s.accepted), ElementsAre(kHidden));
  EXPECT_THAT(ids(s.unnamed), IsEmpty());
  EXPECT_THAT(ids(s.withdrawn), testing::SizeIs(1));
}

// Else what looks like a mistaken channel would be written into the model.
TEST_F(UnnamedCauses, ThatAreImplausibleStayOut) {
  auto causes = least_of_all();
  causes.front().trial.size = causes.front().trial.change = 0.9;
  causes.push_back(improbable_.front());
  Selection s = without_;
  put_back(s, causes);
  EXPECT_THAT(ids(s.unnamed), IsEmpty());
  EXPECT_THAT(ids(s.withdrawn), testing::SizeIs(2));
}

}  // namespace
}  // namespace flexspline::studies
