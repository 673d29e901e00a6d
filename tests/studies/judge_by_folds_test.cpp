// What the whole search leaves of rows that it did not have is the evidence of names.
#include <gtest/gtest.h>

#include "accepted_ids.hpp"
#include "diagnosis/names/confirm.hpp"
#include "diagnosis/names/nested_proof.hpp"
#include "diagnosis/proof/held_out_error.hpp"
#include "searched_drive.hpp"

namespace flexspline::studies {
namespace {

constexpr Eigen::Index kRows = 4000;
constexpr double kSaid = 0.9;  // probability that a fold gives the name

class JudgeByFolds : public SearchedDrive {
 protected:
  void SetUp() override {
    search_hidden(kRows);
    ASSERT_EQ(s_.accepted.size(), 1U);
    auto proof = confirm(frame_, limits_, s_);
    ASSERT_TRUE(proof) << proof.error().message();
    found_ = {frame_, s_, std::move(*proof)};
  }

  /// A search that found nothing, or all that there is.
  SearchedFold fold(bool finds) const {
    SearchedFold fold{frame_.usable, s_.baseline.fit.residual, s_.baseline.fit.residual, {}, {}};
    if (!finds) return fold;
    fold.after = s_.final.fit.residual;
    fold.found = {{{std::string(kHidden)}, kSaid, true}};
    return fold;
  }
  const NameEvidence& evidence() const { return found_.proof.causes.front().name; }

  Finding found_;
};

TEST_F(JudgeByFolds, AnErrorThatNoFoldLowersLeavesNothingOfAName) {
  ASSERT_LT(evidence().over_noise, 0.8 * evidence().before_over_noise);
  ASSERT_GE(probability_of(found_.proof.causes.front()), limits_.probability);
  const double ratio = evidence().ratio;
  judge_by_folds(frame_, {.proving = {fold(false)}}, found_);
  EXPECT_DOUBLE_EQ(evidence().over_noise, evidence().before_over_noise);
  EXPECT_DOUBLE_EQ(evidence().ratio, ratio) << "no fold says what one cause takes";
  const auto named = with_probable_names(found_, limits_);
  ASSERT_TRUE(named) << named.error().message();
  EXPECT_TRUE(named->selection.accepted.empty());
  ASSERT_EQ(named->selection.unnamed.size(), 1U) << "it is needed all the same";
  EXPECT_LT(named->selection.unnamed.front().probability, limits_.probability);
}

TEST_F(JudgeByFolds, TheirErrorsOverTheNoiseAreTaken) {
  judge_by_folds(frame_, {.proving = {fold(true)}}, found_);
  const std::size_t e = index_of(Equation::torsion);
  EXPECT_NEAR(evidence().over_noise / evidence().before_over_noise,
              rms_on(s_.final.fit.residual[e] * s_.final.weight[e], frame_.usable) /
                  rms_on(s_.baseline.fit.residual[e] * s_.final.weight[e], frame_.usable),
              1e-12);
  const auto named = with_probable_names(found_, limits_);
  ASSERT_TRUE(named) << named.error().message();
  EXPECT_EQ(ids(named->selection.accepted), std::vector<std::string_view>{kHidden});
}

// Folds that predict as well by something else.
TEST_F(JudgeByFolds, ANameThatTheyDoNotFindIsNoneOfTheirs) {
  SearchedFold other = fold(true);
  other.found.front().ids = {"something_else"};
  SearchedFold unsure = fold(true);
  unsure.found = {{{"something_else", std::string(kHidden)}, 0.3, false}};
  judge_by_folds(frame_, {.proving = {fold(true), other, unsure}}, found_);
  EXPECT_EQ(evidence().in_folds, (std::vector<double>{kSaid, 0.0, 0.3}));
  judge_by_folds(frame_, {.proving = {fold(true)}, .others = {unsure.found, {}}}, found_);
  EXPECT_EQ(evidence().in_folds, (std::vector<double>{kSaid, 0.3, 0.0})) << "judged or not";
  judge_by_folds(frame_, {.proving = {other, other, other}}, found_);
  EXPECT_EQ(evidence().in_folds, (std::vector<double>{0.0, 0.0, 0.0})) << "not of before, too";
  const auto named = with_probable_names(found_, limits_);
  ASSERT_TRUE(named) << named.error().message();
  EXPECT_TRUE(named->selection.accepted.empty());
}

TEST(StabilityOf, IsTheShareOfFoldsThatNameItOrAnAlternative) {
  NestedProof nested;
  nested.found = {{{{"a", "b"}, 0.8, true}}, {{{"b"}, 0.4, false}}, {{{"c"}, 0.9, true}}, {}};
  Cause cause;
  cause.effect = "a";
  EXPECT_DOUBLE_EQ(stability_of(nested, cause), 0.25);
  cause.alternatives = {"c"};
  EXPECT_DOUBLE_EQ(stability_of(nested, cause), 0.5);
}

TEST_F(JudgeByFolds, AFoldThatFailedOrHasNotTheEquationJudgesNothing) {
  const double before = evidence().over_noise;
  judge_by_folds(frame_, {}, found_);
  judge_by_folds(frame_, {.proving = {fold(false), failure(ErrorCode::numerics, "too few")}}, found_);
  SearchedFold without = fold(false);
  without.after[index_of(Equation::torsion)].resize(0);
  judge_by_folds(frame_, {.proving = {without}}, found_);
  EXPECT_EQ(evidence().over_noise, before);
}

}  // namespace
}  // namespace flexspline::studies
