// Over what a diagnosis shows recordings: what moves in the equation that it proves.
#include <gtest/gtest.h>

#include "diagnosis/spelled.hpp"
#include "drive_frame.hpp"

namespace flexspline::studies {
namespace {

std::vector<DiagnosedSeries> series_on(const Frame& frame, Equation equation) {
  const Eigen::ArrayXd none = Eigen::ArrayXd::Zero(frame.rows());
  return series_of(frame, equation, none, none);
}

/// Least and largest motion of all recordings.
std::pair<double, double> range_of(const std::vector<DiagnosedSeries>& list) {
  double least = 0.0, most = 0.0;
  for (const DiagnosedSeries& one : list) {
    least = std::min(least, *std::ranges::min_element(one.motion));
    most = std::max(most, *std::ranges::max_element(one.motion));
  }
  return {least, most};
}

TEST(DiagnosedSeries, OfAServoIsOverItsJointsAngle) {
  const Frame frame = drawn_frame(Rig::servo);
  const auto [least, most] = range_of(series_on(frame, Equation::motor));
  EXPECT_GT(most - least, 0.5 * (frame.load_angle.maxCoeff() - frame.load_angle.minCoeff()));
  EXPECT_LE(most, frame.load_angle.maxCoeff());
}

TEST(DiagnosedSeries, IsOverTheTorsionWhereThatIsWhatMoves) {
  for (const Rig rig : {Rig::locked, Rig::free}) {
    const Frame frame = drawn_frame(rig);
    EXPECT_LE(range_of(series_on(frame, Equation::torsion)).second, frame.torsion.maxCoeff());
  }
  const Frame locked = drawn_frame(Rig::locked);
  EXPECT_EQ(range_of(series_on(locked, Equation::motor)),
            range_of(series_on(locked, Equation::torsion)));
}

}  // namespace
}  // namespace flexspline::studies
