// Level and colour of a residual's noise, against autoregressions whose own are known.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "autoregression.hpp"
#include "diagnosis/model/noise.hpp"
#include "drive_frame.hpp"
#include "flexspline/core/estimate.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;

TEST(Noise, LevelIsThatOfEachRecordingWhateverChangesSlowlyBesideIt) {
  const Frame frame = closed_form_frame(40000);
  ArrayXd residual = coloured_noise(frame.rows(), 0.0, 2);
  residual.head(20000) *= 0.3;
  residual.tail(20000) *= 0.5;
  for (const double slow : {0.0, 20.0}) {
    const auto level = noise_levels(frame, residual + slow * frame.load_angle);
    ASSERT_EQ(level.size(), 2U);
    EXPECT_NEAR(level[0], 0.3, 0.01);
    EXPECT_NEAR(level[1], 0.5, 0.015);
  }
}

TEST(Noise, AQuietRecordingIsNotTrustedBeyondHalfTheTypicalLevel) {
  const Frame frame = closed_form_frame(8000);
  ArrayXd residual = coloured_noise(frame.rows(), 0.0, 3);
  residual.head(4000) *= 1e-6;
  const auto level = noise_levels(frame, residual);
  EXPECT_NEAR(level[0], 0.5 * level[1], 1e-12);
}

/// Of what the running parabola sees, where nothing repeats.
double colour_seen(const Frame& frame, const ArrayXd& residual) {
  return noise_colour(frame, residual) / kUnseenColour;
}

TEST(Noise, WhiteNoiseHasColourOneAndThereIsNoLess) {
  const Frame frame = closed_form_frame(120000);
  EXPECT_NEAR(colour_seen(frame, coloured_noise(frame.rows(), 0.0, 4)), 1.0, 0.12);
  EXPECT_EQ(colour_seen(frame, ArrayXd::Zero(frame.rows())), 1.0);
}

// Long-run variance over variance of a first-order autoregression: (1 + rho)/(1 - rho). The running
// parabola takes the slow part of it: the estimate is no more than that, and for this noise no more
// than 1. Noise that alternates is as good as white.
TEST(Noise, ColourOfAnAutoregressionIsAtMostItsOwn) {
  const Frame frame = closed_form_frame(120000);
  for (const double rho : {-0.5, 0.3, 0.5, 0.8}) {
    const double colour = colour_seen(frame, coloured_noise(frame.rows(), rho, 4));
    EXPECT_GE(colour, 1.0) << rho;
    EXPECT_LT(colour, std::max(1.05 * (1.0 + rho) / (1.0 - rho), 1.1)) << rho;
  }
}

// The autocorrelation of a first-order process is rho^k.
TEST(Noise, RowsOfAnAutoregressionAreAlikeUntilHalfOfItIsForgotten) {
  const Frame frame = closed_form_frame(40000);
  for (const auto& [rho, alike] : {std::pair{0.0, 1}, {0.45, 1}, {0.6, 2}, {0.75, 3}}) {
    EXPECT_EQ(rows_alike(frame, coloured_noise(frame.rows(), rho, 11)), alike) << rho;
  }
  EXPECT_EQ(rows_alike(frame, ArrayXd::Zero(frame.rows())), 1);
}

TEST(Noise, OneRowOfThoseThatAreAlikeStandsForAll) {
  Frame frame = closed_form_frame(8000);
  frame.usable.head(100).setZero();
  const ArrayXd weight = weights_of(frame, Equation::torsion, {.level = {0.5, 0.4}});
  EXPECT_TRUE((weights_of_fit(frame, weight, 1) == weight).all());
  const ArrayXd few = weights_of_fit(frame, weight, 2);
  EXPECT_EQ((few.tail(4000) > 0.0).count(), 2000);
  EXPECT_NEAR(few.square().sum(), weight.square().sum(), 1e-3 * weight.square().sum());
  EXPECT_EQ(few.head(100).maxCoeff(), 0.0);
  EXPECT_GE((weights_of_fit(frame, weight, 40).tail(4000) > 0.0).count(), 1000)
      << "a recording keeps enough for a fit to it alone";
}

// Of what an equation says nothing of, no noise is told, but that of the rows beside it is: to two
// standard errors of a level by 14 600 rows of this colour, 0.0085, and a twentieth of the colour.
TEST(Noise, RowsThatAreNaNDoNotCountAndAreBridged) {
  const Frame frame = closed_form_frame(40000);
  const ArrayXd noise = coloured_noise(frame.rows(), 0.6, 7);
  const ArrayXd slow = noise + 20.0 * frame.load_angle;
  ArrayXd some = slow;
  for (Eigen::Index r = 10; r + 12 < frame.rows(); r += 45)
    some.segment(r, 12).setConstant(kNotComputed);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(noise_levels(frame, some)[i], noise_levels(frame, slow)[i], 0.02);
  }
  EXPECT_NEAR(noise_colour(frame, some), noise_colour(frame, slow),
              0.05 * noise_colour(frame, slow));
  EXPECT_EQ(rows_alike(frame, some), rows_alike(frame, slow));
  EXPECT_EQ(noise_levels(frame, ArrayXd::Constant(frame.rows(), kNotComputed)),
            std::vector<double>(2, 0.0));
}

TEST(Noise, RowsThatAreNotUsableWeighNothingAndDoNotCount) {
  Frame frame = closed_form_frame(8000);
  frame.usable.segment(1000, 300).setZero();
  ArrayXd residual = coloured_noise(frame.rows(), 0.0, 6);
  const auto clean = noise_levels(frame, residual);
  residual.segment(1000, 300) += 1e6;
  EXPECT_EQ(noise_levels(frame, residual), clean);
  const ArrayXd weight = weights_of(frame, Equation::torsion, {.level = {0.25, 0.5}});
  EXPECT_EQ(weight.segment(1000, 300).abs().maxCoeff(), 0.0);
  EXPECT_EQ(weight[999], 4.0);
  EXPECT_EQ(weight[frame.rows() - 1], 2.0);
}

}  // namespace
}  // namespace flexspline::studies
