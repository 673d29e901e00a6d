// A torque that ripples over the motor's angle.
#include <algorithm>
#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnosis_checks.hpp"

namespace flexspline::studies {
namespace {

// A constant beside a ripple is an offset, however the channel came by it.
TEST(MotorTorqueRipple, LeavesAnOffsetItsName) {
  const auto made =
      drawn_case(Rig::servo, 8, {{"motor_torque_ripple", 0.07}, {"motor_torque_offset", 0.04}});
  const Diagnosis d = diagnosed(made.recordings);
  EXPECT_THAT(names(d),
              testing::UnorderedElementsAre("motor_torque_ripple", "motor_torque_offset"));
}

// The channel of the motor's torque ripples.
TEST(MotorTorqueRipple, IsNamedWhereTheChannelRipples) {
  const auto made = drawn_case(Rig::servo, 8, {{"variant:motor_crosstalk", 0.07}});
  const Diagnosis d = diagnosed(made.recordings);
  EXPECT_EQ(names(d), std::vector<std::string>{"motor_torque_ripple"});
  EXPECT_EQ(std::ranges::count_if(
                d.notes,
                [](const std::string& one) { return one.find("may stick") != std::string::npos; }),
            1)
      << "what the picture shows of standstill is not judged";
}

// A motor that is held turns through a few of the periods that its slots and poles make.
TEST(MotorTorqueRipple, OfALockedDriveIsToldByItsOrder) {
  auto made = drawn_case(Rig::locked, 3);
  double largest = 0.0;
  for (const Recording& r : made.recordings.recordings) {
    for (const double torque : r.channels.at(Quantity::motor_torque)) {
      largest = std::max(largest, std::abs(torque));
    }
  }
  for (Recording& r : made.recordings.recordings) {
    const auto& angle = r.channels.at(Quantity::motor_angle);
    auto& torque = r.channels.at(Quantity::motor_torque);
    for (std::size_t i = 0; i < angle.size(); ++i) {
      torque[i] += 0.04 * largest * std::sin(84.0 * angle[i] + 1.0);
    }
  }
  const Diagnosis d = diagnosed(made.recordings);
  ASSERT_EQ(names(d), std::vector<std::string>{"motor_torque_ripple"});
  EXPECT_EQ(d.causes[0].parameters[0].name, "order");
  EXPECT_DOUBLE_EQ(d.causes[0].parameters[0].value, 84.0);
  EXPECT_NEAR(d.causes[0].size_fraction, 0.04, 0.01);
}

}  // namespace
}  // namespace flexspline::studies
