#include "flexspline/data/sanity.hpp"

#include <cmath>
#include <map>
#include <numbers>

#include <gtest/gtest.h>

#include "damaged_set.hpp"
#include "drive_frame.hpp"
#include "flexspline/data/dataset.hpp"
#include "flexspline/data/sanity_check.hpp"
#include "flexspline/data/sanity_codes.hpp"
#include "flexspline/studies/plan.hpp"
#include "study_file.hpp"

namespace flexspline::studies {
namespace {

using data::sanity_of;
using data::SanityFinding;

std::string said(const std::vector<SanityFinding>& findings) {
  std::string text;
  for (const SanityFinding& one : findings) text += one.check + " " + one.message() + "\n";
  return text;
}

/// One drawn bench a rig.
const RecordingSet& sound(Rig rig) {
  static const std::map<Rig, RecordingSet> sets = [] {
    std::map<Rig, RecordingSet> made;
    for (const Rig each : {Rig::locked, Rig::free, Rig::specimen, Rig::servo}) {
      made[each] = drawn_case(each, 77).recordings;
    }
    return made;
  }();
  return sets.at(rig);
}

TEST(Sanity, SoundBenchesRaiseNoAlarm) {
  for (const Rig rig : {Rig::locked, Rig::free, Rig::specimen, Rig::servo}) {
    EXPECT_EQ(said(sanity_of(sound(rig))), "") << name_of(rig);
  }
}

bool is_a_copy(const RecordingSet& set) {
  return std::ranges::any_of(
      sanity_of(set), [](const SanityFinding& one) { return one.check == "copied_recording"; });
}

// The same motion is asked for twice, and a coarse encoder reads it alike; the torque is another.
TEST(Sanity, TheSameAnglesAreNoCopyTheSameTorquesAre) {
  RecordingSet set = sound(Rig::servo);
  std::vector<double>& angle = set.recordings[1].channels.at(Quantity::load_angle);
  const std::vector<double>& other = set.recordings[0].channels.at(Quantity::load_angle);
  std::copy_n(other.begin(), std::min(angle.size(), other.size()), angle.begin());
  EXPECT_FALSE(is_a_copy(set));
  set.recordings[1].channels = set.recordings[0].channels;
  set.recordings[1].time = set.recordings[0].time;
  EXPECT_TRUE(is_a_copy(set));
}

bool raises(const RecordingSet& set, std::string_view check) {
  return std::ranges::any_of(sanity_of(set),
                             [&](const SanityFinding& one) { return one.check == check; });
}

/// A locked drive under a sine, its angle read in the levels given. Stuck: dry friction holds the
/// motor for a tenth of a second at each reversal, while its torque turns round.
RecordingSet read_in_levels(double level, bool stuck) {
  constexpr double kRate = 4.0, kHeld = 0.1, kTop = 0.2;
  RecordingSet set;
  set.rig = Rig::locked;
  set.constants = {{"gear_ratio", 100.0}, {"motor_inertia_kgm2", 1e-4}};
  Recording& r = set.recordings.emplace_back();
  r.id = "sine";
  const double half = std::numbers::pi / kRate;
  for (double t = 0.0; t < 12.0; t += 2e-3) {
    const double within = std::fmod(t, half + kHeld);
    const double side = std::fmod(t, 2.0 * (half + kHeld)) < half + kHeld ? 1.0 : -1.0;
    const double moved = stuck ? std::min(within, half) : t;
    const double angle = (stuck ? side : 1.0) * kTop * std::cos(kRate * moved);
    const double turned = stuck ? std::max(0.0, within - half) / kHeld : 0.0;
    const double dry = stuck ? side * (2.0 * turned - 1.0) : std::sin(kRate * t) > 0.0 ? -1.0 : 1.0;
    r.time.push_back(t);
    r.channels[Quantity::motor_angle].push_back(level * std::round(angle / level));
    r.channels[Quantity::transmitted_torque].push_back(100.0 * angle + 0.05 * std::sin(311.0 * t));
    r.channels[Quantity::motor_torque].push_back(angle + 0.2 * dry + 1e-3 * std::sin(277.0 * t));
  }
  return set;
}

TEST(Sanity, AMotorThatSticksAtItsReversalsIsNotCutOff) {
  for (const double level : {8e-4, 1e-6}) {
    EXPECT_FALSE(raises(read_in_levels(level, true), "clipped")) << level;
    RecordingSet cut = read_in_levels(level, false);
    EXPECT_FALSE(raises(cut, "clipped")) << level;
    for (double& angle : cut.recordings[0].channels.at(Quantity::motor_angle)) {
      angle = std::clamp(angle, -0.18, 0.18);
    }
    EXPECT_TRUE(raises(cut, "clipped")) << level;
    for (const double angle : cut.recordings[0].channels.at(Quantity::motor_angle)) {
      cut.recordings[0].channels[Quantity::valid].push_back(std::abs(angle) < 0.17 ? 1.0 : 0.0);
    }
    EXPECT_FALSE(raises(cut, "clipped")) << level << ", as the remedy has it";
  }
}

/// The same under a triangle whose motor comes to its tips at full speed and sticks there.
RecordingSet triangle_that_sticks() {
  constexpr double kRate = 0.5, kHeld = 0.1, kTop = 0.2;
  RecordingSet set = read_in_levels(8e-4, true);
  Recording& r = set.recordings[0];
  const double half = 2.0 * kTop / kRate;
  for (std::size_t i = 0; i < r.time.size(); ++i) {
    const double within = std::fmod(r.time[i], half + kHeld);
    const double side = std::fmod(r.time[i], 2.0 * (half + kHeld)) < half + kHeld ? 1.0 : -1.0;
    const double angle = side * (kRate * std::min(within, half) - kTop);
    const double turned = std::max(0.0, within - half) / kHeld;
    r.channels.at(Quantity::motor_angle)[i] = 8e-4 * std::round(angle / 8e-4);
    r.channels.at(Quantity::transmitted_torque)[i] =
        100.0 * angle + 0.05 * std::sin(311.0 * r.time[i]);
    r.channels.at(Quantity::motor_torque)[i] = angle + 0.2 * side * (1.0 - 2.0 * turned);
  }
  return set;
}

TEST(Sanity, AMotorThatSticksAtTheTipsOfATriangleIsNotCutOff) {
  RecordingSet set = triangle_that_sticks();
  EXPECT_FALSE(raises(set, "clipped"));
  auto& angles = set.recordings[0].channels.at(Quantity::motor_angle);
  for (double& angle : angles) angle = std::clamp(angle, -0.16, 0.16);
  EXPECT_TRUE(raises(set, "clipped")) << "the gear's torque goes on";
}

/// A free drive that is moved from one place to another, quickly at first, and rests there, again
/// and again, while its motor's torque holds it.
TEST(Sanity, AnAngleThatRestsAtTheSamePlaceAgainIsNotCutOff) {
  constexpr double kMove = 0.4, kPeriod = 2.0, kTop = 60.0, kLevel = 0.02;
  RecordingSet set;
  set.rig = Rig::free;
  set.constants = {{"gear_ratio", 50.0}, {"motor_inertia_kgm2", 1e-4}, {"load_inertia_kgm2", 1.0}};
  Recording& r = set.recordings.emplace_back();
  r.id = "pick and place";
  for (double t = 0.0; t < 12.0; t += 2e-3) {
    const double within = std::fmod(t, kPeriod);
    const double rise = std::min(within / kMove, 1.0);
    const double fall = std::clamp((within - 0.5 * kPeriod) / kMove, 0.0, 1.0);
    const auto moved = [](double s) { return s * s * s * (10.0 - 15.0 * s + 6.0 * s * s); };
    const double angle = kTop * (moved(rise) - moved(fall));
    r.time.push_back(t);
    r.channels[Quantity::motor_angle].push_back(kLevel * std::round(angle / kLevel));
    r.channels[Quantity::load_angle].push_back(angle / 50.0);
    r.channels[Quantity::motor_torque].push_back(0.3 * std::sin(17.0 * t));
  }
  EXPECT_FALSE(raises(set, "clipped"));
}

void add_row(Recording& r, double t, double load, double motor, double transmitted) {
  r.time.push_back(t);
  r.channels[Quantity::load_angle].push_back(load);
  r.channels[Quantity::motor_angle].push_back(motor);
  r.channels[Quantity::transmitted_torque].push_back(transmitted);
}

/// A free drive that turns mostly its motor, the motor's torque recorded by this factor, the
/// transmitted one by that.
RecordingSet mostly_motor(double of_motor, double of_transmitted) {
  constexpr double kRatio = 100.0, kMotor = 1e-3, kLoad = 2.0;
  RecordingSet set;
  set.rig = Rig::free;
  set.constants = {
      {"gear_ratio", kRatio}, {"motor_inertia_kgm2", kMotor}, {"load_inertia_kgm2", kLoad}};
  for (const double rate : {2.0, 3.0}) {
    Recording& r = set.recordings.emplace_back();
    r.id = "sine-" + std::to_string(rate);
    r.start_s = 20.0 * rate;
    for (double t = 0.0; t < 10.0; t += 4e-3) {
      const double load = 0.8 * std::sin(rate * t);
      const double torque = -rate * rate * load * kLoad;
      const double torsion = torque / 2e4;
      const double motor = kRatio * (load + torsion);
      const double speed = kRatio * rate * 0.8 * std::cos(rate * t) * (1.0 - rate * rate * 1e-4);
      add_row(r, t, load, motor, of_transmitted * (torque + 0.02 * std::sin(311.0 * t)));
      r.channels[Quantity::motor_torque].push_back(
          of_motor * (-rate * rate * motor * kMotor + torque / kRatio + 0.02 * std::tanh(speed) +
                      1e-3 * std::sin(277.0 * t)));
    }
  }
  return set;
}

// An error of 15 % of a motor's torque is 75 % of what is transmitted there: it is no mistake.
TEST(Sanity, AnErrorOfTheMotorsTorqueIsNotOneOfTheTransmitted) {
  EXPECT_FALSE(raises(mostly_motor(1.0, 1.0), "motor_torque"));
  EXPECT_FALSE(raises(mostly_motor(0.85, 1.0), "motor_torque"));
  EXPECT_TRUE(raises(mostly_motor(1000.0, 1.0), "motor_torque"));
  EXPECT_TRUE(raises(mostly_motor(-1.0, 1.0), "motor_torque"));
  // Of the transmitted torque the load tells.
  EXPECT_FALSE(raises(mostly_motor(1.0, 1.0), "load_inertia"));
  EXPECT_TRUE(raises(mostly_motor(1.0, 0.1), "load_inertia"));
}

// A motor's encoder off its centre: the acceleration of its angle is mostly an error.
TEST(Sanity, AnAngleThatRipplesIsNoOtherUnitOfTheTorque) {
  RecordingSet set = mostly_motor(1.0, 1.0);
  for (Recording& r : set.recordings) {
    for (double& angle : r.channels.at(Quantity::motor_angle)) angle += 0.03 * std::sin(angle);
  }
  EXPECT_FALSE(raises(set, "motor_torque"));
  for (Recording& r : set.recordings) {
    for (double& torque : r.channels.at(Quantity::motor_torque)) torque *= 1000.0;
  }
  EXPECT_TRUE(raises(set, "motor_torque"));
}

// Over 15 degrees sin(theta) is theta'' but for a third harmonic of 0.3 %: 2 % of torque in that
// moves the coefficients of both by far more than their standard errors.
TEST(Sanity, AHarmonicOfAShortStrokeIsNoOtherInertia) {
  const auto short_strokes = [](double factor) {
    RecordingSet set;
    set.rig = Rig::free;
    set.constants = {{"gear_ratio", 100.0}, {"load_inertia_kgm2", 2.0}};
    for (const double rate : {6.0, 7.0}) {
      Recording& r = set.recordings.emplace_back();
      r.id = "sine-" + std::to_string(rate);
      r.start_s = 20.0 * rate;
      for (double t = 0.0; t < 6.0; t += 2e-3) {
        const double load = 0.26 * std::sin(rate * t);
        const double torque =
            2.0 * rate * rate * (-load + 0.26 * 0.02 * std::sin(3.0 * rate * t)) * factor;
        add_row(r, t, load, 100.0 * (load + torque / 2e4), torque + 0.01 * std::sin(311.0 * t));
      }
    }
    return set;
  };
  EXPECT_FALSE(raises(short_strokes(1.0), "load_inertia"));
  EXPECT_TRUE(raises(short_strokes(1000.0), "load_inertia"));
}

// Something stiff that one recording runs into pulls more there than the load's mass does; a file
// in another unit is further off.
TEST(Sanity, WhatOneRecordingRunsIntoIsNoOtherUnit) {
  const auto slow_among_fast = [](double bumper, double factor) {
    RecordingSet set;
    set.rig = Rig::free;
    set.constants = {{"gear_ratio", 100.0}, {"load_inertia_kgm2", 2.0}};
    for (const double rate : {1.0, 3.0, 3.5, 4.0}) {
      Recording& r = set.recordings.emplace_back();
      r.id = "sine-" + std::to_string(rate);
      r.start_s = 40.0 * rate;
      for (double t = 0.0; t < 30.0 / rate; t += 5e-3) {
        const double load = std::sin(rate * t);
        const double hit = load > 0.5 ? std::pow((load - 0.5) / 0.5, 1.5) : 0.0;
        const double torque = -2.0 * rate * rate * load + (rate == 1.0 ? bumper * hit : 0.0);
        add_row(r, t, load, 100.0 * (load + torque / 2e4),
                torque * (rate == 1.0 ? factor : 1.0) + 0.01 * std::sin(311.0 * t));
      }
    }
    return set;
  };
  EXPECT_FALSE(raises(slow_among_fast(0.0, 1.0), "load_inertia"));
  EXPECT_FALSE(raises(slow_among_fast(3.5, 1.0), "load_inertia"));
  EXPECT_TRUE(raises(slow_among_fast(3.5, 1000.0), "load_inertia"));
  EXPECT_TRUE(raises(slow_among_fast(0.0, -1.0), "load_inertia"));
}

/// Whether the catalogue has it, as `list checks` prints it.
bool is_listed(const SanityFinding& one) {
  const auto rows = data::sanity_checks();
  const auto row = std::ranges::find(rows, one.check, &data::SanityRow::id);
  return row != rows.end() && std::ranges::any_of(row->verdicts, [&](const auto& verdict) {
           return verdict.code == one.code && verdict.severity == one.severity &&
                  verdict.remedy == one.remedy;
         });
}

TEST(Sanity, EveryCheckSaysWhatItMayAnswer) {
  for (const data::SanityRow& row : data::sanity_checks()) {
    EXPECT_TRUE(data::is_sanity_code(row.id)) << row.id;
    EXPECT_FALSE(row.verdicts.empty()) << row.id;
    for (const data::SanityVerdict& one : row.verdicts) {
      EXPECT_TRUE(data::is_sanity_code(one.code)) << row.id << ": " << one.code;
      EXPECT_FALSE(one.remedy.empty()) << row.id;
    }
  }
}

class SanityOfDamage : public testing::TestWithParam<Damage> {};

TEST_P(SanityOfDamage, IsFoundOnEveryRigThatCanTell) {
  for (const Rig rig : GetParam().rigs) {
    RecordingSet set = sound(rig);
    Draw draw(5);
    GetParam().apply(set, draw);
    const auto findings = sanity_of(set);
    EXPECT_FALSE(findings.empty()) << name_of(rig);
    for (const SanityFinding& one : findings) {
      EXPECT_TRUE(is_listed(one)) << name_of(rig) << ": " << one.check << " " << one.message();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Each, SanityOfDamage, testing::ValuesIn(damages()),
                         [](const auto& tested) {
                           std::string name = tested.param.name;
                           std::erase_if(name, [](char c) { return std::isalnum(c) == 0; });
                           return name;
                         });

/// The finding of one check on a damaged set, with its code.
void expect_code(Rig rig, const std::string& damage, const std::string& code,
                 const std::string& number) {
  const auto found = std::ranges::find(damages(), damage, &Damage::name);
  ASSERT_NE(found, damages().end());
  RecordingSet set = sound(rig);
  Draw draw(5);
  found->apply(set, draw);
  const auto findings = sanity_of(set);
  ASSERT_FALSE(findings.empty());
  EXPECT_EQ(findings.front().severity, data::Severity::error);
  EXPECT_TRUE(data::stops_science(findings));
  EXPECT_TRUE(std::ranges::any_of(findings, [&](const SanityFinding& one) {
    return one.code == code && one.what.find(number) != std::string::npos;
  })) << said(findings);
}

TEST(Sanity, SaysWhichCodeAndTheNumberThatShowsIt) {
  expect_code(Rig::free, "ratio halved", "check_ratio", "2");
  expect_code(Rig::locked, "ms taken for s", "check_units", "0.001");
  expect_code(Rig::locked, "degrees taken for radians", "check_units", "57.3");
  expect_code(Rig::specimen, "sign of the torque", "check_sign", "-");
  expect_code(Rig::locked, "a dead torque", "check_channel", "in every sample");
}

// Where nothing nominal is stated, what the physics of the bench tells is told all the same.
TEST(Sanity, OfAFreeRigNeedsNothingNominal) {
  for (const char* damage : {"ms taken for s", "s taken for ms", "mNm taken for Nm", "ratio halved",
                             "sign of the torque", "both angles exchanged"}) {
    RecordingSet set = sound(Rig::free);
    for (Recording& recording : set.recordings) {
      recording.amplitude.reset(), recording.frequency_hz.reset();
    }
    ASSERT_TRUE(sanity_of(set).empty());
    Draw draw(5);
    std::ranges::find(damages(), damage, &Damage::name)->apply(set, draw);
    EXPECT_TRUE(data::stops_science(sanity_of(set))) << damage;
  }
}

/// A study of a data set of one locked bench, damaged in one way.
Result<StudyPlan> plan_of(const std::string& damage, const ScratchFolder& folder,
                          StudyConfig& study) {
  RecordingSet set = sound(Rig::locked);
  Draw draw(5);
  if (!damage.empty()) std::ranges::find(damages(), damage, &Damage::name)->apply(set, draw);
  EXPECT_TRUE(data::write_dataset(folder.path() / "set", set));
  const auto read = load_study(folder.write(
      "study.toml", kHead + "[[input]]\nid = \"gear\"\ndataset = \"set\"\n" +
                        "[[estimator]]\nid = \"static\"\nmethod = \"static_regression\"\n"));
  EXPECT_TRUE(read) << (read ? "" : read.error().message());
  study = read.value_or(StudyConfig{});
  return plan_study(study, "build");
}

// An error stops a study of the set; a warning does not.
TEST(Sanity, StopsAStudyWhereTheSetLooksMistaken) {
  StudyConfig study;
  for (const char* sound_or_warned : {"", "rows logged twice"}) {
    const ScratchFolder folder;
    const auto plan = plan_of(sound_or_warned, folder, study);
    EXPECT_TRUE(plan) << plan.error().message();
  }
  const ScratchFolder folder;
  const auto plan = plan_of("sign of the torque", folder, study);
  ASSERT_FALSE(plan);
  EXPECT_EQ(plan.error().code, ErrorCode::bad_data);
  EXPECT_NE(plan.error().message().find("input gear: check_sign"), std::string::npos);
  EXPECT_NE(plan.error().message().find("accept = [\""), std::string::npos);
}

TEST(Sanity, AnEmptySetAndAShortRecordingSayNothingAndDoNotFail) {
  RecordingSet set;
  EXPECT_TRUE(sanity_of(set).empty());
  set.recordings.emplace_back();
  EXPECT_TRUE(sanity_of(set).empty());
}

}  // namespace
}  // namespace flexspline::studies
