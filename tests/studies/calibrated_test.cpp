// The probability of a name: the logistic formula, its limits, and what does not exist.
#include "diagnosis/calibrated.hpp"

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
  const NameEvidence one{.ratio = std::sqrt(0.5), .over_noise = 1.1, .left_over = 0.01};
  NameEvidence half = one, more = one, noisier = one, either = one;
  half.ratio = std::sqrt(0.75);
  more.left_over = 0.05;
  noisier.over_noise = 1.21;
  either.alternatives = 1;
  const double share = log_odds(half) - log_odds(one);
  const double left = log_odds(more) - log_odds(one);
  const double misfit = log_odds(noisier) - log_odds(one);
  const double others = log_odds(either) - log_odds(one);
  for (const double term : {share, left, misfit, others}) EXPECT_LT(term, -0.1);
  const NameEvidence all{.ratio = half.ratio, .over_noise = 1.21, .left_over = 0.05, .alternatives = 1};
  EXPECT_NEAR(log_odds(all), log_odds(one) + share + left + misfit + others, 1e-9);
  NameEvidence quarter = one;
  quarter.ratio = std::sqrt(0.875);
  EXPECT_NEAR(log_odds(quarter) - log_odds(half), share, 1e-9) << "by the logarithm of the share";
}

TEST(ProbabilityRight, SaysNoMoreThanWasCalibrated) {
  EXPECT_EQ(probability_right({.ratio = 1.0}), probability_right({.ratio = 2.0}));
  EXPECT_EQ(probability_right({.ratio = 0.5, .over_noise = 0.9}),
            probability_right({.ratio = 0.5, .over_noise = 1.0}));
  EXPECT_EQ(probability_right({.ratio = 0.5, .over_noise = 1.5}),
            probability_right({.ratio = 0.5, .over_noise = 6.0}));
  const double sure = probability_right({.ratio = 0.0});
  EXPECT_GT(sure, 0.95);
  EXPECT_LT(sure, 1.0);
}

TEST(ProbabilityRight, OfWhatWasNotComputedIsNotANumber) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(probability_right({.ratio = kNaN})));
  EXPECT_TRUE(std::isnan(probability_right({.ratio = 0.5, .over_noise = kNaN})));
}

}  // namespace
}  // namespace flexspline::studies
