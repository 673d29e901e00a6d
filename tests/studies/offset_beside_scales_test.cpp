// A torque sensor's offset beside what goes by the torque that it reads: a constant in the motor's
// equation that the offset would stand for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnosis_checks.hpp"

namespace flexspline::studies {
namespace {

constexpr double kOffset = 3.0;            // Nm
constexpr double kKnown = 0.01 * kOffset;  // half of its 95 % interval

// A drive without a fault, read by a sensor with an offset; its motor's torque by a wrong scale.
RecordingSet read_wrongly(double motor_scale, double sensor_scale) {
  RecordingSet set = drawn_case(Rig::locked, 5).recordings;
  for (Recording& r : set.recordings) {
    for (double& x : r.channels.at(Quantity::motor_torque)) x *= motor_scale;
    for (double& x : r.channels.at(Quantity::transmitted_torque)) x = x * sensor_scale + kOffset;
  }
  return set;
}

CauseParameter offset_in(const Diagnosis& d) {
  const auto offset = std::ranges::find(d.causes, "torque_sensor_offset", &Cause::effect);
  EXPECT_NE(offset, d.causes.end()) << d.says;
  return offset == d.causes.end() ? CauseParameter{} : offset->parameters.front();
}

TEST(OffsetOfATorqueSensor, IsNotScaledByWhatScalesTheMotorsTorque) {
  const CauseParameter offset = offset_in(diagnosed(read_wrongly(1.0 / 1.1, 1.0)));
  EXPECT_NEAR(offset.value, kOffset, kKnown);
}

TEST(OffsetOfATorqueSensor, ComesAfterTheSensorsGain) {
  const CauseParameter offset = offset_in(diagnosed(read_wrongly(1.0, 1.1)));
  EXPECT_NEAR(offset.value, kOffset, kKnown);
}

}  // namespace
}  // namespace flexspline::studies
