// A cause that fails on recordings held out gives way to what explains the same signal nearly as
// well and holds there.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "accepted_ids.hpp"
#include "diagnosis/confirm.hpp"
#include "diagnosis/spelled.hpp"
#include "drive_frame.hpp"

namespace flexspline::studies {
namespace {

constexpr std::string_view kHidden = "presliding_hysteresis";
constexpr Eigen::Index kRows = 16000;

class Rivals : public testing::Test {
 protected:
  void SetUp() override {
    const auto hidden = drawn_case(Rig::locked, 201, {{std::string(kHidden), 0.06}});
    auto made = make_frame(hidden.recordings, kRows);
    ASSERT_TRUE(made) << made.error().message();
    frame_ = std::move(*made);
  }

  // Causes tried on the baseline, the hidden one first, the least of the others behind it.
  std::vector<Trial> tried(const Selection& s) const {
    auto trials = try_causes(frame_, s.baseline);
    std::erase_if(trials, [](const Trial& t) { return t.cause.row == nullptr; });
    EXPECT_EQ(trials.front().cause.row->id, kHidden);
    std::ranges::sort(trials.begin() + 1, trials.end(), {}, &Trial::gain);
    return trials;
  }

  // As if a search had taken one of them, and another had explained nearly as much.
  Selection accepted(std::size_t taken, std::size_t rival) {
    auto selection = select_causes(frame_, limits_, {});
    EXPECT_TRUE(selection) << selection.error().message();
    Selection s = *std::move(selection);
    EXPECT_TRUE(settle_baseline(frame_, s));
    EXPECT_THAT(ids(s.accepted), testing::ElementsAre(kHidden));
    const auto trials = tried(s);
    Accepted& a = s.accepted.front();
    a.trial = trials.at(taken);
    a.rivals = {trials.at(rival)};
    s.final.fit = a.trial.fit;
    EXPECT_TRUE(fit_all(frame_, s.final, 0));
    return s;
  }

  Frame frame_;
  Limits limits_;
};

TEST_F(Rivals, OfACauseThatFailsTakesItsPlaceWhereItHolds) {
  Selection s = accepted(1, 0);
  const auto proof = confirm(frame_, limits_, s);
  ASSERT_TRUE(proof) << proof.error().message();
  EXPECT_THAT(ids(s.accepted), testing::ElementsAre(kHidden));
  EXPECT_LT(proof->holdout.ratio, 0.8);
  ASSERT_THAT(ids(s.withdrawn), testing::SizeIs(1));
  EXPECT_THAT(std::string(s.withdrawn.front().withdrawn_because),
              testing::HasSubstr("an alternative they do"));
}

TEST_F(Rivals, OfACauseThatHoldsStayBehindIt) {
  Selection s = accepted(0, 1);
  const auto proof = confirm(frame_, limits_, s);
  ASSERT_TRUE(proof) << proof.error().message();
  EXPECT_THAT(ids(s.accepted), testing::ElementsAre(kHidden));
  EXPECT_TRUE(s.withdrawn.empty());
}

TEST_F(Rivals, ThatFailAsWellAreNotNamed) {
  Selection s = accepted(1, 2);
  const auto proof = confirm(frame_, limits_, s);
  ASSERT_TRUE(proof) << proof.error().message();
  EXPECT_TRUE(s.accepted.empty());
}

TEST_F(Rivals, StandWithANameThatIsMoreLikelyRightThanWrong) {
  Selection s = accepted(0, 1);
  auto proof = confirm(frame_, limits_, s);
  ASSERT_TRUE(proof) << proof.error().message();
  ASSERT_EQ(proof->causes.size(), 1U);
  const CauseProof& cause = proof->causes.front();
  EXPECT_EQ(cause.name.alternatives, 1U);
  EXPECT_GT(cause.gain, 100.0 * limits_.gain);
  EXPECT_LT(cause.name.over_noise, cause.name.before_over_noise);

  limits_.probability = 1.0;
  Selection doubted = accepted(0, 1);
  proof = confirm(frame_, limits_, doubted);
  ASSERT_TRUE(proof) << proof.error().message();
  EXPECT_TRUE(doubted.accepted.empty());
  ASSERT_THAT(ids(doubted.unnamed), testing::ElementsAre(kHidden));
  NameEvidence either = cause.name;
  either.alternatives = 0;
  // Both fits end within 0.02 of a chi square of thousands.
  EXPECT_NEAR(doubted.unnamed.front().probability, probability_right(either), 1e-3);
  EXPECT_TRUE(doubted.remainder) << "no name explains it";
  EXPECT_LT(proof->holdout.ratio, 0.8) << "but the model has it";
}

TEST_F(Rivals, ThatAreNamedThemselvesAreNoAlternatives) {
  Selection s = accepted(0, 1);
  const std::string rival(s.accepted.front().rivals.front().cause.row->id);
  Proof proof;
  proof.causes.resize(2);
  EXPECT_THAT(spelled_causes(frame_, s, proof).front().alternatives, testing::ElementsAre(rival));
  Accepted other;
  other.trial = s.accepted.front().rivals.front();
  s.accepted.push_back(other);
  s.final.fit.model.causes.push_back(other.trial.cause);
  s.final.fit.model.coefficients.push_back(Eigen::VectorXd::Ones(1));
  EXPECT_THAT(spelled_causes(frame_, s, proof).front().alternatives, testing::IsEmpty());
}

}  // namespace
}  // namespace flexspline::studies
