// A motion that comes again, and noise as what does not: closed forms and autoregressions.
#include <gtest/gtest.h>

#include <numbers>

#include "autoregression.hpp"
#include "diagnosis/frame/repeats.hpp"
#include "diagnosis/model/noise.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr double kTurn = 2.0 * std::numbers::pi;

ArrayXd cycles(Index rows, double period) {
  return kTurn / period * ArrayXd::LinSpaced(rows, 0.0, static_cast<double>(rows - 1));
}

TEST(RepeatOf, ASineIsItsPeriodToHalfARow) {
  for (const double period : {60.0, 113.5, 300.25}) {
    const Repeat repeat = repeat_of(cycles(900, period).sin());
    EXPECT_LE(std::abs(static_cast<double>(repeat.period) - period), 0.5) << period;
    EXPECT_EQ(repeat.rows, 900 - repeat.period);
  }
}

TEST(RepeatOf, AMotionThatIsEasedInRepeatsLater) {
  const ArrayXd phase = cycles(900, 300.0);
  const ArrayXd ease = (phase / kTurn).min(1.0);
  const Repeat repeat = repeat_of(ease * phase.sin());
  EXPECT_EQ(repeat.period, 300);
  EXPECT_NEAR(static_cast<double>(repeat.rows), 300.0, 30.0) << "the first cycle is another";
}

TEST(RepeatOf, WhatDoesNotComeAgainHasNone) {
  const ArrayXd phase = cycles(900, 300.0);
  EXPECT_EQ(repeat_of(phase).period, 0) << "a ramp";
  EXPECT_EQ(repeat_of((phase + 0.3 * phase.square()).sin()).period, 0) << "a chirp";
  EXPECT_EQ(repeat_of((1.0 - 0.1 * phase / kTurn) * phase.sin()).period, 0) << "it dies away";
  EXPECT_EQ(repeat_of(phase.sin() + (std::numbers::sqrt2 * phase).sin()).period, 0);
  EXPECT_EQ(repeat_of(ArrayXd::Constant(900, 2.0)).period, 0);
  EXPECT_EQ(repeat_of(cycles(390, 300.0).sin()).period, 0) << "too few rows to compare";
  EXPECT_EQ(repeat_of(ArrayXd()).period, 0);
}

/// Two recordings of ten cycles of 600 rows; the second may not repeat.
Frame repeating_frame(bool both) {
  Frame f;
  f.segments = {{"one", 0, 6000, Split::unassigned, {600, 5400}},
                {"two", 6000, 6000, Split::unassigned, both ? Repeat{600, 5400} : Repeat{}}};
  f.usable = ArrayXd::Ones(12000);
  return f;
}

// Whatever a model misses of a motion that repeats is no noise, as far as the parabola follows it.
TEST(NoiseThatDoesNotRepeat, HasTheLevelAndColourOfAnAutoregression) {
  const Frame frame = repeating_frame(true);
  const ArrayXd missed = 5.0 * cycles(12000, 600.0).sin() + 2.0 * cycles(12000, 200.0).cos();
  for (const double rho : {0.0, 0.8, 0.95}) {
    const ArrayXd noise = 0.3 * coloured_noise(12000, rho, 5);
    for (const double level : noise_levels(frame, noise + missed)) {
      EXPECT_NEAR(level, 0.3, 0.03) << rho;
    }
    const double colour = (1.0 + rho) / (1.0 - rho);
    EXPECT_NEAR(noise_colour(frame, noise + missed), colour, 0.35 * colour) << rho;
  }
}

TEST(NoiseThatDoesNotRepeat, IsTakenForTheOthersToo) {
  const Frame frame = repeating_frame(false);
  const ArrayXd noise = 0.3 * coloured_noise(12000, 0.95, 6);
  const auto level = noise_levels(frame, noise);
  EXPECT_NEAR(level[0], 0.3, 0.03);
  EXPECT_NEAR(level[1], 0.3, 0.06);
}

TEST(NoiseThatDoesNotRepeat, LeavesOutRowsThatAreNotUsable) {
  Frame frame = repeating_frame(true);
  ArrayXd residual = coloured_noise(12000, 0.0, 7);
  frame.usable.segment(1000, 200).setZero();
  const auto level = noise_levels(frame, residual);
  residual.segment(1000, 200).setConstant(1e9);
  EXPECT_EQ(noise_levels(frame, residual), level);
  EXPECT_LT(noise_colour(frame, residual), 1.3);
}

}  // namespace
}  // namespace flexspline::studies
