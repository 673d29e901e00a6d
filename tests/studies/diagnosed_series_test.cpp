// Over what a diagnosis shows recordings: what moves in the equation that it proves.
#include <gtest/gtest.h>

#include "diagnosis/proof/series.hpp"
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

TEST(DiagnosedSeries, TheModelIsShownWhereItIsJudgedAlone) {
  Frame frame = drawn_frame(Rig::free);
  frame.motor_slides = Eigen::ArrayXd::Ones(frame.rows());
  const Segment& first = frame.segments.front();
  frame.motor_slides.segment(first.first, first.count).setZero();
  const auto motor = series_on(frame, Equation::motor);
  EXPECT_TRUE(std::ranges::all_of(motor.front().before, [](double v) { return std::isnan(v); }));
  EXPECT_TRUE(std::ranges::none_of(motor.front().measured, [](double v) { return std::isnan(v); }));
  const auto torsion = series_on(frame, Equation::torsion);
  for (const auto* one : {&torsion.front(), &motor.back()}) {
    EXPECT_TRUE(std::ranges::none_of(one->after, [](double v) { return std::isnan(v); }));
  }
}

TEST(DiagnosedSeries, AnIncidentThatIsLeftOutIsShown) {
  Frame frame = drawn_frame(Rig::locked);
  const auto whole = series_on(frame, Equation::torsion);
  const Segment& first = frame.segments.front();
  const Eigen::Index count = first.count / 2;
  frame.incidents.push_back({Equation::torsion, 0, first.first + first.count - count, count, 0.1});
  frame.usable.segment(first.first + first.count - count, count).setZero();
  const auto shown = series_on(frame, Equation::torsion);
  EXPECT_GE(shown.front().time.back(), whole.front().time.back());
  EXPECT_TRUE(std::ranges::none_of(shown.front().after, [](double v) { return std::isnan(v); }));
}

}  // namespace
}  // namespace flexspline::studies
