// Accelerations behind the bandwidths that the torque tells.
#include "diagnosis/search/bandwidths.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "diagnosis/frame/accelerations.hpp"
#include "studies/drive_frame.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr Index kMostRows = 16000;

/// The angle of a log that is faster than its encoder: counts of 12 bit, read every fourth row, and
/// a line between.
RecordingSet interpolated(RecordingSet set) {
  constexpr double kLevel = 2.0 * std::numbers::pi / 4096.0;
  for (Recording& recording : set.recordings) {
    auto& angle = recording.channels[Quantity::load_angle];
    for (double& x : angle) x = kLevel * std::round(x / kLevel);
    for (std::size_t i = 0; i + 4 < angle.size(); i += 4) {
      for (std::size_t k = 1; k < 4; ++k) {
        angle[i + k] = angle[i] + 0.25 * static_cast<double>(k) * (angle[i + 4] - angle[i]);
      }
    }
  }
  return set;
}

Frame frame_of(const RecordingSet& set) {
  auto frame = make_frame(set, kMostRows);
  EXPECT_TRUE(frame.has_value());
  return frame ? *std::move(frame) : Frame{};
}

double rms_of_baseline(const Frame& frame) {
  const auto baseline = fit_baseline(frame);
  EXPECT_TRUE(baseline.has_value());
  const ArrayXd rows = frame.rows_of(Equation::motor);
  const ArrayXd& residual = baseline->fit.residual[index_of(Equation::motor)];
  return std::sqrt((rows * residual.square()).sum() / rows.sum());
}

std::vector<std::size_t> best_of_baseline(const Frame& frame) {
  const auto baseline = fit_baseline(frame);
  EXPECT_TRUE(baseline.has_value());
  return best_bandwidths(frame, *baseline);
}

TEST(Bandwidths, OfSamplesThatWereMeasuredAreThoseOfTheirMotion) {
  const Frame frame = frame_of(drawn_case(Rig::servo, 7).recordings);
  ASSERT_NE(frame.accelerations, nullptr);
  EXPECT_EQ(best_of_baseline(frame), bandwidths_of(frame));
}

TEST(Bandwidths, OfAnglesThatWereInterpolatedAreNarrower) {
  const Frame frame = frame_of(interpolated(drawn_case(Rig::servo, 7).recordings));
  const auto best = best_of_baseline(frame);
  EXPECT_NE(best, bandwidths_of(frame));
  const double before = rms_of_baseline(frame);
  const double after = rms_of_baseline(with_bandwidths(frame, best));
  EXPECT_LT(after, 0.7 * before);
}

TEST(Bandwidths, OfTheMotionGiveTheFrameBack) {
  const Frame frame = frame_of(drawn_case(Rig::servo, 7).recordings);
  const std::vector<std::size_t> narrowest(frame.segments.size(), kNarrower.size());
  const Frame there = with_bandwidths(frame, narrowest);
  EXPECT_GT((there.motor_acceleration - frame.motor_acceleration).abs().maxCoeff(), 0.0);
  const Frame back = with_bandwidths(there, bandwidths_of(frame));
  EXPECT_TRUE((back.motor_acceleration == frame.motor_acceleration).all());
  EXPECT_TRUE((back.load_acceleration == frame.load_acceleration).all());
  EXPECT_TRUE((back.torque == frame.torque).all());
  EXPECT_TRUE((back.motor_bandwidth == frame.motor_bandwidth).all());
}

// A spline of bandwidth b forgets an end by exp(-b t/2).
TEST(Bandwidths, LetNoRowBeJudgedBesideAnEnd) {
  const Frame frame = frame_of(drawn_case(Rig::servo, 7).recordings);
  const Frame other = with_bandwidths(frame, std::vector<std::size_t>(frame.segments.size(), 1));
  const ArrayXd rows = other.rows_of(Equation::motor);
  for (const Segment& s : other.segments) {
    const double end = 4.0 / other.motor_bandwidth[s.first];
    for (Index r = s.first; other.time[r] - other.time[s.first] < end; ++r) {
      EXPECT_EQ(rows[r], 0.0) << s.id << " " << r - s.first;
    }
  }
}

}  // namespace
}  // namespace flexspline::studies
