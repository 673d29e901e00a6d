// A torque sensor's offset beside what goes by the torque that it reads: a constant in the motor's
// equation that the offset would stand for.
#include <cmath>

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

CauseParameter offset_in(const Diagnosis& d, std::string_view effect = "torque_sensor_offset") {
  const auto offset = std::ranges::find(d.causes, effect, &Cause::effect);
  EXPECT_NE(offset, d.causes.end()) << effect << ": " << d.says;
  return offset == d.causes.end() ? CauseParameter{} : offset->parameters.front();
}

// What the motor's torque is before a scale by which it is recorded.
RecordingSet with_motor_offset(RecordingSet set, double offset, double scale) {
  for (Recording& r : set.recordings) {
    for (double& x : r.channels.at(Quantity::motor_torque)) x = (x + offset) * scale;
  }
  return set;
}

TEST(OffsetOfATorqueSensor, IsNotScaledByWhatScalesTheMotorsTorque) {
  const CauseParameter offset = offset_in(diagnosed(read_wrongly(1.0 / 1.1, 1.0)));
  EXPECT_NEAR(offset.value, kOffset, kKnown);
}

// The two make one constant in the motor's equation; that of the sensor is told by the spring's
// bends alone, beside a zero of the angle.
TEST(OffsetOfATorqueSensor, IsToldFromOneOfTheMotor) {
  constexpr double kOfMotor = -0.13;
  const Diagnosis d = diagnosed(with_motor_offset(read_wrongly(1.0, 1.0), kOfMotor, 1.0));
  const CauseParameter sensor = offset_in(d);
  const CauseParameter motor = offset_in(d, "motor_torque_offset");
  EXPECT_NEAR(sensor.value, kOffset, sensor.ci95_upper - sensor.ci95_lower);
  EXPECT_NEAR(motor.value, kOfMotor, motor.ci95_upper - motor.ci95_lower);
  EXPECT_LT(motor.ci95_upper - motor.ci95_lower, 0.2 * std::abs(kOfMotor));
}

// As in a model file, where true torque is (1 + e) of what is recorded.
TEST(OffsetOfAMotor, IsCountedInTrueTorque) {
  constexpr double kOfMotor = 0.1, kScale = 1.0 / 1.1;
  RecordingSet set = drawn_case(Rig::locked, 5).recordings;
  const Diagnosis d = diagnosed(with_motor_offset(std::move(set), kOfMotor, kScale));
  const CauseParameter offset = offset_in(d, "motor_torque_offset");
  const double known = offset.ci95_upper - offset.ci95_lower;
  EXPECT_LT(known, (1.0 - kScale) * kOfMotor);
  EXPECT_NEAR(offset.value, kOfMotor, known);
  EXPECT_NEAR(offset_in(d, "torque_constant_error").value, 1.0 / kScale - 1.0, 0.01);
}

TEST(OffsetOfATorqueSensor, ComesAfterTheSensorsGain) {
  const CauseParameter offset = offset_in(diagnosed(read_wrongly(1.0, 1.1)));
  EXPECT_NEAR(offset.value, kOffset, kKnown);
}

}  // namespace
}  // namespace flexspline::studies
