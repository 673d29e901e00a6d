// The ripple of the motor that told a specimen's torque, over the torsion as it was recorded.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnosis/names/finding.hpp"
#include "diagnosis/names/judged_once.hpp"
#include "diagnosis_checks.hpp"
#include "mounted_gear.hpp"

namespace flexspline::studies {
namespace {

constexpr double kRatio = 50.0;
constexpr double kOrder = 21.0;
constexpr double kRipple = 0.3;  // Nm, 2 % of the largest torque

RecordingSet rippling(double ratio, const MountedGear& gear = {}) {
  RecordingSet set = gear.recordings();
  if (ratio > 1.0) set.constants["gear_ratio"] = ratio;
  for (Recording& r : set.recordings) {
    const auto& torsion = r.channels.at(Quantity::torsion);
    auto& torque = r.channels.at(Quantity::torque);
    for (std::size_t i = 0; i < torque.size(); ++i) {
      torque[i] += kRipple * std::sin(kOrder * kRatio * torsion[i] + 0.4);
    }
  }
  return set;
}

TEST(RippleOfASpecimen, IsNamedWithItsOrderAndSize) {
  const Diagnosis d = diagnosed(rippling(kRatio));
  EXPECT_THAT(names(d),
              testing::UnorderedElementsAre("presliding_hysteresis", "motor_torque_ripple"))
      << d.says;
  const auto ripple = std::ranges::find(d.causes, "motor_torque_ripple", &Cause::effect);
  ASSERT_NE(ripple, d.causes.end());
  const auto parameter = [&](std::string_view name) {
    return std::ranges::find(ripple->parameters, name, &CauseParameter::name)->value;
  };
  EXPECT_EQ(parameter("order"), kOrder);
  // f, a spline over seven periods of it, follows some of the ripple.
  EXPECT_NEAR(std::hypot(parameter("sine"), parameter("cosine")), kRipple, 0.05 * kRipple);
  EXPECT_NEAR(std::atan2(parameter("cosine"), parameter("sine")), 0.4, 0.05);
}

Eigen::ArrayXd recorded(const Frame& frame, const Segment& s) {
  return frame.torsion.segment(s.first, s.count) + (frame.zero + s.zero);
}

// The phase is that of the motor, wherever a search counts a mounting from.
TEST(RippleOfASpecimen, GoesByTheTorsionAsRecordedWhereRecordingsAreJudged) {
  const RecordingSet all = rippling(kRatio, MountedGear{.zeros = {0.0, 0.013, -0.02}});
  const auto searched = make_frame(*without(all, {all.recordings.back().id}), 16000);
  const auto whole = make_frame(all, 16000);
  ASSERT_TRUE(searched && whole);
  const auto finding = find_causes(*searched, Limits{}, {});
  ASSERT_TRUE(finding) << finding.error().message();
  Eigen::ArrayXd held = Eigen::ArrayXd::Zero(whole->rows());
  const auto last = std::ranges::find(whole->segments, all.recordings.back().id, &Segment::id);
  held.segment(last->first, last->count).setOnes();
  const auto judged = judge(*whole, held, *finding);
  ASSERT_TRUE(judged) << judged.error().message();
  double moved = 0.0;
  for (std::size_t i = 0; i < whole->segments.size(); ++i) {
    const Segment& before = whole->segments[i];
    const Segment& after = judged->frame.segments[i];
    moved = std::max(moved, std::abs(after.zero - before.zero));
    EXPECT_TRUE(recorded(judged->frame, after).isApprox(recorded(*whole, before), 1e-12)) << i;
  }
  EXPECT_GT(moved, 1e-6);  // rad
}

TEST(RippleOfASpecimen, HasNoNameWithoutAGearRatio) {
  const Diagnosis d = diagnosed(rippling(1.0));
  EXPECT_THAT(names(d), testing::ElementsAre("presliding_hysteresis")) << d.says;
}

}  // namespace
}  // namespace flexspline::studies
