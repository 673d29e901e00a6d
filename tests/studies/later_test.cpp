// A signal of rows that are far apart, moved in time.
#include <cmath>

#include <gtest/gtest.h>

#include "diagnosis/frame/low_pass.hpp"
#include "diagnosis/model/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

Frame two_recordings(Index rows, double interval) {
  Frame frame;
  const ArrayXd time = interval * ArrayXd::LinSpaced(rows, 0.0, static_cast<double>(rows - 1));
  frame.time.resize(2 * rows);
  frame.time << time, time;
  frame.segments = {{"one", 0, rows}, {"two", rows, rows}};
  return frame;
}

double worst_of_inner_rows(const Frame& frame, const ArrayXd& error) {
  double worst = 0.0;
  for (const Segment& s : frame.segments) {
    worst = std::max(worst, error.segment(s.first + 3, s.count - 6).abs().maxCoeff());
  }
  return worst;
}

double worst_of_sine(double interval) {
  const auto rows = static_cast<Index>(std::lround(6.0 / interval));
  const Frame frame = two_recordings(rows, interval);
  const double delay = 1.3 * interval;
  const ArrayXd moved = later(frame, frame.time.sin(), -delay);
  return worst_of_inner_rows(frame, moved - (frame.time - delay).sin());
}

TEST(Later, IsOfThirdOrderBetweenRows) {
  const double coarse = worst_of_sine(0.1), fine = worst_of_sine(0.05);
  EXPECT_LT(coarse, 0.1 * 0.1 * 0.1 / 6.0);  // linear between rows: up to 0.1^2/8
  EXPECT_GT(coarse / fine, 7.5);
}

TEST(Later, HoldsWhatIsBeyondTheEndsOfARecording) {
  const Frame frame = two_recordings(50, 0.1);
  const ArrayXd moved = later(frame, frame.time, 100.0);
  EXPECT_EQ(moved[10], frame.time[49]);
  EXPECT_EQ(later(frame, frame.time, -100.0)[60], frame.time[50]);
}

TEST(LowPass, GivesBackWhatItIsUndoneBy) {
  Frame frame = two_recordings(80, 0.1);
  frame.time += 0.02 * (2.0 * frame.time).sin();  // rows that are not evenly apart
  const ArrayXd signal = (3.0 * frame.time).sin() + 0.2 * frame.time;
  for (const double time_constant : {0.01, 0.1, 1.0}) {
    Eigen::MatrixXd before = LowPass(frame, time_constant).undone(signal);
    LowPass(frame, time_constant).apply(before);
    EXPECT_LT((before.array() - signal).abs().maxCoeff(), 1e-12) << time_constant;
  }
}

}  // namespace
}  // namespace flexspline::studies
