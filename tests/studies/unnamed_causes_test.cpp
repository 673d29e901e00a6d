// Causes whose names are improbable: in the model without them where something is left and
// recordings held out confirm them.
#include "diagnosis/names/unnamed_causes.hpp"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "accepted_ids.hpp"
#include "diagnosis/names/confirm.hpp"
#include "searched_drive.hpp"

namespace flexspline::studies {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

constexpr Eigen::Index kRows = 4000;

class UnnamedCauses : public SearchedDrive {
 protected:
  void SetUp() override {
    search_hidden(kRows);
    ASSERT_THAT(ids(s_.accepted), ElementsAre(kHidden));
  }

  // Of the causes that are no friction.
  Trial least_of_all() {
    auto trials = try_causes(frame_, s_.baseline);
    std::erase_if(trials, [](const Trial& t) {
      return t.cause.row == nullptr || t.cause.row->of_baseline() ||
             !t.cause.row->outside.empty() || t.cause.form->friction;
    });
    return *std::ranges::min_element(trials, {}, &Trial::gain);
  }

  // Puts it before the hidden cause.
  void add_least_of_all() {
    Accepted least = s_.accepted.front();
    least.trial = least_of_all();
    s_.final.fit = least.trial.fit;
    ASSERT_TRUE(fit_all(frame_, s_.final, 0));
    auto both = extended(frame_, s_.final, s_.accepted.front().trial.cause, 8);
    ASSERT_TRUE(both) << both.error().message();
    s_.final.fit = std::move(*both);
    s_.accepted.insert(s_.accepted.begin(), std::move(least));
  }

  void put_the_hidden_first() {
    std::ranges::reverse(s_.accepted);
    std::ranges::reverse(s_.final.fit.model.causes);
    std::ranges::reverse(s_.final.fit.model.coefficients);
  }

  // With probabilities of the names that are given.
  Proof take_names(const std::vector<double>& probabilities) {
    auto proof = prove(frame_, s_, 0);
    EXPECT_TRUE(proof);
    for (std::size_t i = 0; i < probabilities.size(); ++i) {
      proof->causes[i].name = evidence_for(probabilities[i]);
    }
    before_ = proof->holdout;
    auto after = take_improbable_names(frame_, limits_, s_, std::move(*proof));
    EXPECT_TRUE(after) << after.error().message();
    return std::move(*after);
  }

  // A name of that probability, by what is left beside it.
  static NameEvidence evidence_for(double probability) {
    NameEvidence name{.ratio = 0.9, .over_noise = 1.0, .before_over_noise = 3.0};
    double lower = 1.0, upper = 3.0;
    while (upper - lower > 1e-6) {
      name.over_noise = 0.5 * (lower + upper);
      (probability_right(name) > probability ? lower : upper) = name.over_noise;
    }
    return name;
  }

  HoldoutProof before_;
};

TEST_F(UnnamedCauses, StayInTheModelWhereSomethingIsLeftWithoutThem) {
  const auto proof = take_names({0.2});
  EXPECT_THAT(ids(s_.accepted), IsEmpty());
  EXPECT_THAT(ids(s_.unnamed), ElementsAre(kHidden));
  EXPECT_NEAR(s_.unnamed.front().probability, 0.2, 1e-4);
  EXPECT_THAT(ids(s_.withdrawn), IsEmpty());
  EXPECT_TRUE(s_.remainder) << "no name explains it";
  EXPECT_TRUE(proof.causes.empty()) << "a proof is of names";
  EXPECT_LT(proof.holdout.ratio, 0.8);
  EXPECT_DOUBLE_EQ(proof.holdout.rmse_after, before_.rmse_after);
  EXPECT_EQ(s_.final.fit.model.causes.size(), 1U);
}

// The floor is of what it adds to the model that stands, not of what it added when it was found.
TEST_F(UnnamedCauses, AreThoseOfNoInterestWhateverTheirNamesProbability) {
  Accepted& hidden = s_.accepted.front();
  limits_.interest = 1.1 * hidden.trial.size;
  take_names({0.985});
  EXPECT_THAT(ids(s_.accepted), IsEmpty());
  ASSERT_THAT(ids(s_.unnamed), ElementsAre(kHidden));
  EXPECT_FALSE(s_.unnamed.front().material);
  EXPECT_NEAR(s_.unnamed.front().probability, 0.985, 1e-4) << "the name is no less likely for it";
}

// What only a form without a name follows is left beside the names, as a table's would be.
TEST_F(UnnamedCauses, AreLeftOverBesideThoseThatAreNamed) {
  auto proof = prove(frame_, s_, 0);
  ASSERT_TRUE(proof);
  take_left_over(frame_, s_.final, s_, *proof);
  const double beside_all = proof->causes.front().name.left_over;
  take_left_over(frame_, s_.baseline, s_, *proof);
  const double beside_none = proof->causes.front().name.left_over;
  EXPECT_GT(beside_none, 1e-3) << "from where on it lowers a probability";
  EXPECT_LT(beside_all, 0.1 * beside_none);
  take_left_over(frame_, s_.final, s_, *proof);
  EXPECT_EQ(proof->causes.front().name.left_over, beside_none) << "once said, it stays";
}

TEST_F(UnnamedCauses, StandBehindThoseThatAreNamed) {
  add_least_of_all();
  put_the_hidden_first();
  const DriveModel model = s_.final.fit.model;
  const std::string_view named = s_.accepted.back().trial.cause.row->id;
  const auto proof = take_names({0.2, 0.985});
  EXPECT_THAT(ids(s_.accepted), ElementsAre(named));
  EXPECT_THAT(ids(s_.unnamed), ElementsAre(kHidden));
  ASSERT_EQ(proof.causes.size(), 1U);
  EXPECT_LT(probability_of(proof.causes.front()), 0.985) << "what the other follows is left over";
  const DriveModel& moved = s_.final.fit.model;
  EXPECT_EQ(moved.causes[0].row, model.causes[1].row);
  EXPECT_EQ(moved.coefficients[0], model.coefficients[1]);
  EXPECT_EQ(moved.causes[1].row, model.causes[0].row);
  EXPECT_EQ(moved.coefficients[1], model.coefficients[0]);
}

TEST_F(UnnamedCauses, TakeNamesAlongThatExplainLess) {
  add_least_of_all();
  put_the_hidden_first();
  const std::string_view least = s_.accepted.back().trial.cause.row->id;
  const auto proof = take_names({0.2, 0.9});
  EXPECT_THAT(ids(s_.accepted), IsEmpty());
  EXPECT_THAT(ids(s_.unnamed), ElementsAre(least, kHidden));
  EXPECT_TRUE(proof.causes.empty());
}

TEST_F(UnnamedCauses, AreWithdrawnWhereTheNamedLeaveNothing) {
  add_least_of_all();
  const auto proof = take_names({0.2, 0.9});
  EXPECT_THAT(ids(s_.accepted), ElementsAre(kHidden));
  EXPECT_THAT(ids(s_.unnamed), IsEmpty());
  EXPECT_THAT(ids(s_.withdrawn), SizeIs(1));
  EXPECT_EQ(s_.final.fit.model.causes.size(), 1U);
  EXPECT_FALSE(s_.remainder);
  ASSERT_EQ(proof.causes.size(), 1U);
}

// Nothing is hidden, and noise is all that is left without it.
TEST_F(UnnamedCauses, AloneAreSomethingFromTheInterestOn) {
  for (const double share : {0.99, 1.01}) {
    s_ = {};
    search({}, kRows);
    ASSERT_THAT(ids(s_.accepted), IsEmpty());
    Accepted alone;
    alone.trial = least_of_all();
    alone.trial.size = share * limits_.interest;
    s_.final.fit = alone.trial.fit;
    s_.accepted.push_back(std::move(alone));
    take_names({0.2});
    EXPECT_THAT(ids(s_.accepted), IsEmpty());
    EXPECT_THAT(ids(s_.unnamed), SizeIs(share > 1.0 ? 1 : 0));
    EXPECT_THAT(ids(s_.withdrawn), SizeIs(share > 1.0 ? 0 : 1));
  }
}

// Else what looks like a mistaken channel would be written into the model.
TEST_F(UnnamedCauses, AreWithdrawnWhereOneIsImplausible) {
  add_least_of_all();
  s_.accepted.front().trial.size = s_.accepted.front().trial.change = 0.9;
  take_names({0.2, 0.2});
  EXPECT_THAT(ids(s_.unnamed), IsEmpty());
  EXPECT_THAT(ids(s_.withdrawn), SizeIs(2));
  EXPECT_TRUE(s_.final.fit.model.causes.empty());
}

}  // namespace
}  // namespace flexspline::studies
