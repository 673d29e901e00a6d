// What is left has to be more than noise, and of interest.
#include <gtest/gtest.h>

#include "diagnosis/search/explanation.hpp"
#include "diagnosis_checks.hpp"

namespace flexspline::studies {
namespace {

TEST(IsLeft, AsksForEvidenceAShareOfTheResidualAndASizeOfInterest) {
  const Limits limits;
  const auto score = [](double statistic, double share, double size) {
    return CoordinateScore{Equation::torsion, "torsion", statistic, share, size, ""};
  };
  EXPECT_TRUE(is_left(score(100.0, 0.3, 0.01), limits));
  EXPECT_FALSE(is_left(score(10.0, 0.3, 0.01), limits)) << "noise does as much";
  EXPECT_FALSE(is_left(score(100.0, 0.05, 0.01), limits)) << "of little of what is left";
  EXPECT_FALSE(is_left(score(100.0, 0.3, 0.003), limits)) << "below the floor of interest";
  Limits finer;
  finer.interest = 0.004;
  EXPECT_TRUE(is_left(score(100.0, 0.3, 0.003), finer)) << "which the user sets";
}

// Residuals of three times the noise: of a torque sensor that is nearly free of noise they may be
// nothing that anyone asks for.
TEST(IsFittedBeyondNoise, AsksForATorqueOfInterest) {
  const Frame frame = closed_form_frame();
  const Limits limits;
  const auto left = [&](double misfit_share, double noise_share) {
    Findings findings;
    for (const Equation each : frame.equations) {
      const std::size_t e = index_of(each);
      const double largest = frame.largest_torque(each);
      findings.fit.residual[e].setConstant(frame.rows(), misfit_share * largest);
      findings.weight[e] = frame.usable / (noise_share * largest);
    }
    return is_fitted_beyond_noise(frame, findings, limits);
  };
  EXPECT_TRUE(left(0.003, 0.001));
  EXPECT_FALSE(left(0.003, 0.0025)) << "noise is the larger part";
  EXPECT_FALSE(left(0.0015, 0.0005)) << "a trifle";
}

}  // namespace
}  // namespace flexspline::studies
