#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "flexspline/core/torsion_record.hpp"

namespace flexspline {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

RecordingSet bench(Rig rig, std::map<Quantity, std::vector<double>> channels) {
  RecordingSet set;
  set.name = "bench";
  set.rig = rig;
  set.constants["gear_ratio"] = 50.0;
  Recording recording;
  recording.id = "sine-1";
  recording.amplitude = 0.5;
  recording.frequency_hz = 0.25;
  recording.split = Split::holdout;
  recording.time = {0.0, 0.1, 0.2};
  recording.channels = std::move(channels);
  set.recordings.push_back(std::move(recording));
  return set;
}

TorsionRecord view(const RecordingSet& set) { return torsion_records(set).value().front(); }

std::string refusal(const RecordingSet& set) {
  const auto records = torsion_records(set);
  return records ? "" : records.error().message();
}

TEST(TorsionRecord, OnTheLockedRigIsTheMotorAngleAtTheOutput) {
  const auto record = view(bench(Rig::locked, {{Quantity::motor_angle, {0.0, 50.0, -25.0}},
                                               {Quantity::transmitted_torque, {1.0, 2.0, 3.0}}}));
  EXPECT_THAT(record.motion, ElementsAre(0.0, 1.0, -0.5));
  EXPECT_THAT(record.effort, ElementsAre(1.0, 2.0, 3.0));
  EXPECT_THAT(record.time, ElementsAre(0.0, 0.1, 0.2));
  EXPECT_THAT(record.valid, ElementsAre(true, true, true));
  EXPECT_EQ(record.id, "sine-1");
  EXPECT_EQ(record.split, Split::holdout);
  EXPECT_EQ(record.amplitude, 0.5);
  EXPECT_EQ(record.frequency_hz, 0.25);
  EXPECT_FALSE(record.travels);
}

// J2 theta_l'' of a sine in closed form, but for the smoothing of its ends.
TEST(TorsionRecord, OnAFreeRigWithoutASensorHasTheTorqueOfTheInertia) {
  RecordingSet set = bench(Rig::free, {});
  set.constants["load_inertia_kgm2"] = 2.0;
  Recording& r = set.recordings.front();
  r.time.clear();
  for (int i = 0; i < 1000; ++i) {
    const double t = 4e-3 * i;
    r.time.push_back(t);
    r.channels[Quantity::load_angle].push_back(0.3 * std::sin(5.0 * t));
    r.channels[Quantity::motor_angle].push_back(15.0 * std::sin(5.0 * t));
  }
  const auto record = view(set);
  for (std::size_t i = 100; i < 900; ++i) {
    EXPECT_NEAR(record.effort[i], -2.0 * 0.3 * 25.0 * std::sin(5.0 * r.time[i]), 0.05) << i;
  }
  set.constants.erase("load_inertia_kgm2");
  EXPECT_THAT(refusal(set), HasSubstr("no transmitted_torque"));
}

TEST(TorsionRecord, OnTheFreeRigIsTheDifferenceOfTheShafts) {
  const auto record = view(bench(Rig::free, {{Quantity::motor_angle, {0.0, 50.0, 100.0}},
                                             {Quantity::load_angle, {0.0, 0.75, 2.5}},
                                             {Quantity::transmitted_torque, {1.0, 2.0, 3.0}}}));
  EXPECT_THAT(record.motion, ElementsAre(0.0, 0.25, -0.5));
  EXPECT_FALSE(record.amplitude.has_value()) << "that of the load angle is not that of torsion";
}

TEST(TorsionRecord, OfASpecimenTakesItsOwnMotionAndEffort) {
  const auto damper = view(bench(Rig::specimen, {{Quantity::displacement, {0.0, 0.1, 0.2}},
                                                 {Quantity::force, {5.0, 6.0, 7.0}},
                                                 {Quantity::valid, {1.0, 0.0, 1.0}}}));
  EXPECT_THAT(damper.motion, ElementsAre(0.0, 0.1, 0.2));
  EXPECT_THAT(damper.effort, ElementsAre(5.0, 6.0, 7.0));
  EXPECT_THAT(damper.valid, ElementsAre(true, false, true));
  EXPECT_FALSE(damper.travels);
  const auto joint = view(bench(
      Rig::specimen, {{Quantity::angle, {0.0, 0.1, 0.2}}, {Quantity::torque, {5.0, 6.0, 7.0}}}));
  EXPECT_TRUE(joint.travels);
}

TEST(TorsionRecord, NamesWhatIsMissingAndWhere) {
  auto set = bench(Rig::free, {{Quantity::motor_angle, {0.0, 1.0, 2.0}},
                               {Quantity::load_angle, {0.0, 1.0, 2.0}}});
  EXPECT_THAT(refusal(set), HasSubstr("bench: recording sine-1: no transmitted_torque"));
  set.constants.clear();
  EXPECT_THAT(refusal(set), HasSubstr("no gear_ratio"));
  EXPECT_THAT(refusal(bench(Rig::locked, {})), HasSubstr("no motor_angle"));
  EXPECT_THAT(refusal(bench(Rig::specimen, {{Quantity::force, {0.0, 0.0, 0.0}}})),
              HasSubstr("no torsion, displacement or angle"));
  EXPECT_THAT(refusal(bench(Rig::servo, {{Quantity::load_angle, {0.0, 0.0, 0.0}}})),
              HasSubstr("servo rig measures no torque"));
}

}  // namespace
}  // namespace flexspline
