// The ripple of the motor that told a specimen's torque, over the torsion as it was recorded.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnosis_checks.hpp"
#include "mounted_gear.hpp"

namespace flexspline::studies {
namespace {

constexpr double kRatio = 50.0;
constexpr double kOrder = 21.0;
constexpr double kRipple = 0.3;  // Nm, 2 % of the largest torque

RecordingSet rippling(double ratio) {
  RecordingSet set = MountedGear{}.recordings();
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
  EXPECT_NEAR(std::hypot(parameter("sine"), parameter("cosine")), kRipple, 0.05 * kRipple);
  EXPECT_NEAR(std::atan2(parameter("cosine"), parameter("sine")), 0.4, 0.05);
}

TEST(RippleOfASpecimen, HasNoNameWithoutAGearRatio) {
  const Diagnosis d = diagnosed(rippling(1.0));
  EXPECT_THAT(names(d), testing::ElementsAre("presliding_hysteresis")) << d.says;
}

}  // namespace
}  // namespace flexspline::studies
