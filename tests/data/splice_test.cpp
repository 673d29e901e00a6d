#include <cmath>

#include <gmock/gmock.h>

#include "bench/local_parabola.hpp"
#include "flexspline/data/splice.hpp"
#include "hidden_fixture.hpp"

namespace flexspline::data {
namespace {

/// A specimen's recordings of its rest-free motion a sin(w t), and a linear spring with a damper.
RecordingSet linear_set() {
  RecordingSet set;
  set.name = "linear";
  set.rig = Rig::specimen;
  for (const double rate : {2.0, 7.0}) {
    Recording& r = set.recordings.emplace_back();
    r.id = "w" + std::to_string(static_cast<int>(rate));
    r.start_s = rate;
    for (int k = 0; k < 2000; ++k) {
      const double t = k * 2e-3;
      r.time.push_back(t);
      r.channels[Quantity::torsion].push_back(3e-3 * std::sin(rate * t));
      r.channels[Quantity::torque].push_back(30.0 * std::sin(rate * t) + 2.0 * std::cos(rate * t));
    }
  }
  return set;
}

TEST(LocalParabolas, AreExactForAParabolaAtAnyInstants) {
  std::vector<double> time, values;
  for (int k = 0; k < 40; ++k) {
    time.push_back(0.1 * k + 0.03 * std::sin(3.0 * k));
    values.push_back(2.0 - 3.0 * time.back() + 0.7 * time.back() * time.back());
  }
  const std::vector<Jet> jets = local_parabolas(time, values);
  for (std::size_t k = 0; k < time.size(); ++k) {
    EXPECT_NEAR(jets[k].value, values[k], 1e-10);
    EXPECT_NEAR(jets[k].first, -3.0 + 1.4 * time[k], 1e-8);
    EXPECT_NEAR(jets[k].second, 1.4, 1e-6);
  }
}

TEST(Splice, AddsAnInertiaTorqueAsItsClosedForm) {
  const RecordingSet set = linear_set();
  const auto spliced = splice(set, {"inertia_torque", 0.05}, 9);
  ASSERT_TRUE(spliced) << spliced.error().message();
  EXPECT_NEAR(spliced->finding.size_fraction, 0.05, 0.001);
  const double inertia = spliced->finding.parameters.at(0).value;
  for (std::size_t i = 0; i < set.recordings.size(); ++i) {
    const Recording& plain = set.recordings[i];
    const double rate = i == 0 ? 2.0 : 7.0;
    for (std::size_t k = 10; k + 10 < plain.time.size(); k += 37) {
      const double added = spliced->set.recordings[i].channels.at(Quantity::torque)[k] -
                           plain.channels.at(Quantity::torque)[k];
      const double wanted = -inertia * rate * rate * 3e-3 * std::sin(rate * plain.time[k]);
      EXPECT_NEAR(added, wanted, 0.002 * 0.05 * spliced->peak_torque);
    }
  }
}

TEST(Splice, OfEverySpliceableEffectHasItsSizeAndLeavesTheMotion) {
  const RecordingSet set = linear_set();
  const std::vector<std::string> ids = spliceable(set);
  EXPECT_THAT(ids, testing::IsSupersetOf({"presliding_hysteresis", "stribeck_friction",
                                          "viscoelastic_creep", "sensor_delay"}));
  EXPECT_THAT(ids, testing::Not(testing::Contains("backlash"))) << "acts in series";
  for (const std::string& id : ids) {
    const auto spliced = splice(set, {id, 0.03}, 4);
    ASSERT_TRUE(spliced) << id << ": " << spliced.error().message();
    double most = 0.0;
    for (std::size_t i = 0; i < set.recordings.size(); ++i) {
      const Recording& with = spliced->set.recordings[i];
      EXPECT_EQ(with.channels.at(Quantity::torsion),
                set.recordings[i].channels.at(Quantity::torsion));
      for (std::size_t k = 0; k < with.time.size(); ++k) {
        most = std::max(most, std::abs(with.channels.at(Quantity::torque)[k] -
                                       set.recordings[i].channels.at(Quantity::torque)[k]));
      }
    }
    EXPECT_NEAR(most / spliced->peak_torque, 0.03, 0.0007) << id;
  }
}

TEST(Splice, IsRefusedWhereItCannotBeAdded) {
  EXPECT_FALSE(splice(linear_set(), {"backlash", 0.05}, 1));
  RecordingSet servo = linear_set();
  servo.rig = Rig::servo;
  EXPECT_TRUE(spliceable(servo).empty());
}

TEST(SpliceChanges, AreWhatTheyAreCalled) {
  const RecordingSet set = linear_set();
  const auto& before = set.recordings[0].channels.at(Quantity::torsion);
  const auto mirrored = changed(set, "mirrored", 1).value();
  EXPECT_EQ(mirrored.recordings[0].channels.at(Quantity::torsion)[100], -before[100]);
  EXPECT_EQ(mirrored.recordings[0].time, set.recordings[0].time);
  const auto thinned = changed(set, "every_second", 1).value();
  EXPECT_EQ(thinned.recordings[0].time.size(), 1000U);
  EXPECT_EQ(thinned.recordings[0].channels.at(Quantity::torsion)[50], before[100]);
  EXPECT_EQ(changed(set, "first_70", 1).value().recordings[0].time.size(), 1400U);
  EXPECT_EQ(changed(set, "one_left_out", 1).value().recordings.size(), 1U);
  EXPECT_TRUE(same_bits(changed(set, "none", 1).value(), set));
  EXPECT_FALSE(changed(set, "reversed", 1));
  RecordingSet one = set;
  one.recordings.pop_back();
  EXPECT_FALSE(changed(one, "one_left_out", 1));
}

}  // namespace
}  // namespace flexspline::data
