#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "damaged_set.hpp"
#include "diagnosis/names/undecided.hpp"
#include "diagnosis_checks.hpp"
#include "flexspline/studies/diagnosis_json.hpp"

namespace flexspline::studies {
namespace {

void expect_undecided(const Diagnosis& d) {
  EXPECT_EQ(d.verdict, Verdict::undecided) << d.says;
  EXPECT_TRUE(d.causes.empty());
  EXPECT_NE(d.says.find("Cannot be decided"), std::string::npos) << d.says;
  const auto json = to_json(d);
  EXPECT_EQ(json["verdict"], "undecided");
  EXPECT_EQ(json["says"], d.says);
  EXPECT_TRUE(json["model"].is_null());
}

/// Two sines of a torsion, and a torque that is white noise.
RecordingSet noise_set() {
  std::mt19937_64 engine(17);
  std::normal_distribution<double> normal;
  RecordingSet set;
  set.rig = Rig::specimen;
  for (int r = 0; r < 3; ++r) {
    Recording& one = set.recordings.emplace_back();
    one.id = "r" + std::to_string(r);
    const double rate = 1.0 + r;
    for (int k = 0; k < 900; ++k) {
      one.time.push_back(0.01 * k);
      one.channels[Quantity::torsion].push_back((2.0 + r) * 1e-3 * std::sin(rate * 0.01 * k));
      one.channels[Quantity::torque].push_back(normal(engine));
    }
  }
  return set;
}

TEST(Undecided, OneLoopDecidesNothing) {
  RecordingSet set = drawn_case(Rig::locked, 202, {{"presliding_hysteresis", 0.06}}).recordings;
  set.recordings.resize(1);
  const Diagnosis d = diagnosed(set);
  expect_undecided(d);
  ASSERT_TRUE(d.next_experiment);
}

TEST(Undecided, WhiteNoiseDecidesNothing) {
  const Diagnosis d = diagnosed(noise_set());
  expect_undecided(d);
  EXPECT_NE(d.says.find("noise"), std::string::npos) << d.says;
}

TEST(Undecided, ADeadChannelInOneRecordingDecidesNothing) {
  RecordingSet set = drawn_case(Rig::locked, 101).recordings;
  std::ranges::fill(set.recordings[2].channels.at(Quantity::transmitted_torque), 0.25);
  const Diagnosis d = diagnosed(set);
  expect_undecided(d);
  const auto note = to_json(d)["notes"][0];
  EXPECT_EQ(note["code"], "check_channel");
  EXPECT_EQ(note["recording"], set.recordings[2].id);
  EXPECT_NE(note["says"].get<std::string>().find("0.25"), std::string::npos);
}

TEST(Undecided, AChannelDeadInEveryRecordingIsUnusable) {
  RecordingSet set = drawn_case(Rig::free, 103).recordings;
  for (Recording& recording : set.recordings) {
    std::ranges::fill(recording.channels.at(Quantity::motor_angle), 0.0);
  }
  const auto refused = diagnose(set);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::bad_data);
  EXPECT_NE(refused.error().message().find("motor_angle"), std::string::npos);
}

class UndecidedByDamage : public testing::TestWithParam<const char*> {};

// What was called physics before: inertia, torque constants, skews.
TEST_P(UndecidedByDamage, NamesNoPhysics) {
  RecordingSet set = drawn_case(Rig::free, 103).recordings;
  Draw draw(3);
  std::ranges::find(damages(), GetParam(), &Damage::name)->apply(set, draw);
  const Diagnosis d = diagnosed(set);
  expect_undecided(d);
  ASSERT_FALSE(d.mistaken.empty());
  EXPECT_EQ(d.mistaken.front().code.substr(0, 6), "check_");
}

INSTANTIATE_TEST_SUITE_P(Each, UndecidedByDamage,
                         testing::Values("ms taken for s", "degrees taken for radians",
                                         "ratio halved", "sign of the torque",
                                         "both angles exchanged", "a torque cut off",
                                         "a frozen torque", "a torque of zero for a while"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           std::erase_if(name, [](char c) { return std::isalnum(c) == 0; });
                           return name;
                         });

/// A selection of one accepted cause of a given size and coefficient.
Selection one_cause(const CauseRow& row, double size, double coefficient) {
  Selection s;
  Accepted a;
  a.trial.cause = {&row, &row.forms.front(), {}};
  a.trial.size = a.trial.change = size;
  s.accepted = {a};
  s.final.fit.model.causes = {a.trial.cause};
  s.final.fit.model.coefficients = {Eigen::VectorXd::Constant(1, coefficient)};
  return s;
}

const CauseRow& cause_row(std::string_view id) {
  return *std::ranges::find(causes(), id, &CauseRow::id);
}

TEST(Implausible, IsMoreThanHalfOfTheTorqueOrAGainOffByAFactor) {
  const Frame frame = closed_form_frame();
  const auto codes = [&](std::string_view id, double size, double coefficient) {
    std::string list;
    for (const auto& one : implausible(frame, one_cause(cause_row(id), size, coefficient), {})) {
      list += one.code + " ";
    }
    return list;
  };
  EXPECT_EQ(codes("gravity_load", 0.6, 1.0), "check_units ");
  EXPECT_EQ(codes("gravity_load", 0.3, 1.0), "");
  EXPECT_EQ(codes("torque_sensor_gain", 0.2, 0.6), "check_units ");
  EXPECT_EQ(codes("torque_sensor_gain", 0.2, -1.99), "check_sign ");
  EXPECT_EQ(codes("torque_sensor_gain", 0.2, 0.1), "");
  EXPECT_EQ(codes("presliding_hysteresis", 0.9, 1.0), "") << "friction may be all of a torque";
  EXPECT_EQ(codes("kinematic_error", 0.6, 1.0), "") << "a stiff spring and a fast motion make it";
  EXPECT_EQ(codes("inertia_torque", 0.6, 1.0), "") << "nobody said what a specimen carries";
}

// What turns has a mass: less of it than half of what is stated is none.
TEST(Implausible, IsAnInertiaThatIsTakenAway) {
  const Frame frame = closed_form_frame();
  const CauseRow& row = cause_row("inertia_torque");
  for (const auto& [equation, stated] : {std::pair(Equation::load, frame.load_inertia),
                                         std::pair(Equation::motor, frame.motor_inertia)}) {
    const auto form = std::ranges::find_if(
        row.forms, [&](const CauseForm& f) { return f.at == std::vector{equation}; });
    ASSERT_NE(form, row.forms.end());
    const auto taken = [&](double share) {
      Selection s = one_cause(row, 0.2, -share * stated);
      s.accepted[0].trial.cause.form = &*form;
      return implausible(frame, s, {});
    };
    EXPECT_TRUE(taken(0.4).empty());
    EXPECT_TRUE(taken(-5.0).empty()) << "what was forgotten may be more than what is stated";
    ASSERT_EQ(taken(0.6).size(), 1U);
    EXPECT_NE(taken(0.6)[0].message().find("kg m2 beside the"), std::string::npos);
  }
}

TEST(Implausible, IsNoLateTorqueOfAMotorThatLacksAKick) {
  const Frame frame = closed_form_frame();
  const CauseRow& row = cause_row("current_lag");
  Selection s = one_cause(row, 0.7, 0.03);
  s.accepted[0].trial.cause.form = &row.forms.back();
  ASSERT_TRUE(row.forms.back().trails);
  EXPECT_TRUE(implausible(frame, s, {}).empty());
  s.accepted[0].trial.cause.form = &row.forms.front();
  EXPECT_FALSE(implausible(frame, s, {}).empty()) << "a series in T holds for small ones";
}

}  // namespace
}  // namespace flexspline::studies
