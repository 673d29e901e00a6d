// The probability of a name: the logistic formula, its limits, and what does not exist.
#include "diagnosis/proof/calibrated.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace flexspline::studies {
namespace {

double log_odds(const NameEvidence& evidence) {
  const double p = probability_right(evidence);
  return std::log(p / (1.0 - p));
}

// Each number moves the log odds by its own term, whatever the others are.
TEST(ProbabilityRight, IsLinearInTheLogOdds) {
  const NameEvidence one{.ratio = std::sqrt(0.5),
                         .over_noise = std::sqrt(1.1),
                         .before_over_noise = std::sqrt(3.0),
                         .left_over = 0.01};
  NameEvidence half = one, more = one, worse = one, either = one, all = one;
  half.ratio = all.ratio = std::sqrt(0.75);
  more.left_over = all.left_over = 0.05;
  worse.over_noise = all.over_noise = std::sqrt(1.2);
  either.alternatives = all.alternatives = 1;
  double sum = log_odds(one);
  for (const NameEvidence& other : {half, more, worse, either}) {
    const double term = log_odds(other) - log_odds(one);
    EXPECT_LT(term, -0.1);
    sum += term;
  }
  EXPECT_NEAR(log_odds(all), sum, 1e-9);
  NameEvidence quarter = one;
  quarter.ratio = std::sqrt(0.875);
  EXPECT_NEAR(log_odds(quarter) - log_odds(half), log_odds(half) - log_odds(one), 1e-9)
      << "by the logarithm of the share";
}

// Of the baseline's mean square, noise included, what is left beyond noise.
TEST(ProbabilityRight, GoesByTheShareThatIsLeftBeyondNoise) {
  const auto of = [](double before, double after) {
    return probability_right({.ratio = 0.5,
                              .over_noise = std::sqrt(1.0 + after),
                              .before_over_noise = std::sqrt(1.0 + before),
                              .left_over = 0.01});
  };
  EXPECT_NEAR(of(8.0, 1.5), of(2.0, 0.5), 1e-12) << "a sixth";
  EXPECT_GT(of(8.0, 0.5), of(8.0, 2.0));
  EXPECT_LT(of(8.0, 8.0), 0.5) << "a name that leaves all is more likely wrong than right";
}

TEST(ProbabilityRight, SaysNoMoreThanWasCalibrated) {
  EXPECT_EQ(probability_right({.ratio = 1.0}), probability_right({.ratio = 2.0}));
  EXPECT_EQ(probability_right({.ratio = 0.5, .over_noise = 0.9, .before_over_noise = 2.0}),
            probability_right({.ratio = 0.5, .over_noise = 1.0, .before_over_noise = 2.0}));
  EXPECT_EQ(probability_right({.ratio = 0.5, .over_noise = 3.0, .before_over_noise = 2.0}),
            probability_right({.ratio = 0.5, .over_noise = 6.0, .before_over_noise = 2.0}));
  const double sure = probability_right({.ratio = 0.0});
  EXPECT_GT(sure, 0.95);
  EXPECT_LT(sure, 1.0);
}

TEST(ProbabilityRight, IsTheMeanOfWhatTheSearchesSay) {
  NameEvidence name{.ratio = 0.5, .over_noise = 1.1, .before_over_noise = 3.0, .left_over = 0.01};
  const double alone = probability_right(name);
  name.in_folds = {alone, alone};
  EXPECT_DOUBLE_EQ(probability_right(name), alone) << "folds that agree say no more";
  name.in_folds = {0.0, 0.4, 0.9};
  EXPECT_DOUBLE_EQ(probability_right(name), (alone + 0.0 + 0.4 + 0.9) / 4.0);
}

TEST(ProbabilityRight, OfWhatWasNotComputedIsNotANumber) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(probability_right({.ratio = kNaN})));
  EXPECT_TRUE(std::isnan(probability_right({.ratio = 0.5, .over_noise = kNaN})));
}

}  // namespace
}  // namespace flexspline::studies
