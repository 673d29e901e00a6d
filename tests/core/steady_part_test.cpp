// Finding the steady part of a record, and the closed forms of its loop.
#include <gtest/gtest.h>

#include "flexspline/core/signals.hpp"
#include "loop_records.hpp"

namespace flexspline {
namespace {

constexpr double kPi = std::numbers::pi;

double ellipse(double x, double v) { return 5.0 * x + 0.3 * v; }

TEST(SteadyPart, IsTheWholeOfARecordThatRepeats) {
  const auto steady = find_steady_part(sine_record(4, 200, ellipse));
  ASSERT_TRUE(steady);
  EXPECT_EQ(steady->first, 0U);
  EXPECT_EQ(steady->last, 801U);
  EXPECT_EQ(steady->cycles, 4);
  EXPECT_NEAR(steady->period, 1.0, 1e-9);
}

TEST(SteadyPart, BeginsAfterTheRunUp) {
  auto record = sine_record(6, 200, ellipse);
  for (std::size_t i = 0; i < 400; ++i) {  // two cycles that grow
    const double share = static_cast<double>(i) / 400.0;
    record.motion[i] *= share;
    record.effort[i] *= share;
  }
  const auto steady = find_steady_part(record);
  ASSERT_TRUE(steady);
  EXPECT_EQ(steady->cycles, 4);
  EXPECT_NEAR(record.time[steady->first], 2.0, 0.01);
  EXPECT_NEAR(steady->period, 1.0, 1e-6);
}

TEST(SteadyPart, IsAbsentWithoutTwoCyclesOrRepetition) {
  EXPECT_FALSE(find_steady_part(sine_record(1.5, 200, ellipse)));
  auto growing = sine_record(4, 200, ellipse);
  for (std::size_t i = 0; i < growing.time.size(); ++i)
    growing.motion[i] *= std::exp(growing.time[i]);
  EXPECT_FALSE(find_steady_part(growing));
  auto stuck = sine_record(4, 200, ellipse);
  for (double& x : stuck.motion) x = 0.001;
  EXPECT_FALSE(find_steady_part(stuck));
  auto travelling = sine_record(4, 200, ellipse);
  travelling.travels = true;
  EXPECT_FALSE(find_steady_part(travelling));
}

TEST(LoopFigures, OfAnEllipse) {
  const auto figures = loop_figures(sine_record(4, 400, ellipse));
  ASSERT_TRUE(figures);
  const double damping = 0.3 * 4.0 * kPi;  // amplitude of 0.3 v
  // A polygon of n corners covers sinc(2 pi/n) of its circle: 1.6e-4 less with two hundred.
  EXPECT_NEAR(figures->area / (kPi * 2.0 * damping), 1.0, 3e-4);
  EXPECT_NEAR(figures->half_height / damping, 1.0, 3e-4);
  EXPECT_NEAR(figures->peak_effort / std::hypot(10.0, damping), 1.0, 3e-4);
}

// Energy per cycle (2 pi/w) sum_k b_k (A w)^(2k) (2k-1)!!/(2k)!!; the spring drops out.
TEST(LoopFigures, LoseTheClosedFormOfAnOddPolynomialDamper) {
  const double b[] = {0.4, 0.02, 3e-4};
  const auto law = [&b](double x, double v) {
    return 5.0 * x + 2.0 * x * x * x + b[0] * v + b[1] * v * v * v + b[2] * std::pow(v, 5);
  };
  const double speed = 4.0 * kPi;
  double expected = 0.0;
  double ratio = 1.0;
  for (int k = 1; k <= 3; ++k) {
    ratio *= (2.0 * k - 1.0) / (2.0 * k);
    expected += b[k - 1] * std::pow(speed, 2 * k) * ratio;
  }
  const auto figures = loop_figures(sine_record(4, 400, law));
  ASSERT_TRUE(figures);
  EXPECT_NEAR(figures->area / expected, 1.0, 1e-3);
}

TEST(LoopFigures, AreAbsentWithoutALoop) {
  EXPECT_FALSE(loop_figures(sine_record(1, 200, ellipse)));
}

}  // namespace
}  // namespace flexspline
