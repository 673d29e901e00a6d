// Which recording is proposed on each rig: within what was recorded, and with the separation that a
// closed form gives.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "active_cause.hpp"
#include "diagnosis/frame/middle.hpp"
#include "diagnosis/next/experiment.hpp"
#include "diagnosis/next/next_motion.hpp"
#include "drive_frame.hpp"
#include "printed_name.hpp"

namespace flexspline::studies {
namespace {

struct PlannedRig {
  std::string name;
  data::BenchKind kind;
};

std::ostream& operator<<(std::ostream& out, const PlannedRig& one) { return out << one.name; }

struct Known {
  Frame frame;
  Findings findings;
};

Known known(const data::BenchKind& kind) {
  ConcealPlan plan;
  plan.rig = kind;
  plan.seed = 3;
  const auto made = conceal(plan);
  EXPECT_TRUE(made) << made.error().message();
  auto frame = make_frame(made->recordings, 4000);
  EXPECT_TRUE(frame) << frame.error().message();
  auto findings = fit_baseline(*frame);
  EXPECT_TRUE(findings) << findings.error().message();
  return {std::move(*frame), std::move(*findings)};
}

class NextMotions : public testing::TestWithParam<PlannedRig> {};

TEST_P(NextMotions, GoNoFurtherAndNoFasterThanTheRecordings) {
  const auto [frame, findings] = known(GetParam().kind);
  const auto motions = next_motions(frame, findings.fit.model);
  ASSERT_GE(motions.size(), 3u);
  const auto largest = [](const Frame& f, Eigen::ArrayXd Frame::*channel) {
    return (f.*channel).abs().maxCoeff();
  };
  for (const NextMotion& one : motions) {
    EXPECT_GT(one.amplitude, 0.0);
    for (auto channel : {&Frame::torsion, &Frame::torsion_rate, &Frame::motor_speed,
                         &Frame::load_angle, &Frame::motor_torque}) {
      EXPECT_LE(largest(one.frame, channel), 1.03 * largest(frame, channel)) << one.says;
    }
  }
}

constexpr double kSmall = 1e-4;  // of the largest torque: an offset makes a free rig drift away

/// Two explanations of a selection: a cause, and the baseline as it is.
Selection undecided(const Known& known, const CauseRow& row, const CauseForm& form) {
  Selection s;
  s.final = known.findings;
  Trial best{active(known.frame, row, form)};
  best.fit.model = with_cause(known.frame, known.findings, row, form, kSmall);
  Trial other = best;
  other.fit.model = known.findings.fit.model;
  s.accepted.push_back({.trial = best, .rivals = {other}, .field = {}});
  return s;
}

// Models that differ by a constant torque c differ by c sqrt(n)/sigma along every motion.
TEST_P(NextMotions, SeparateAnOffsetAsTheClosedFormSays) {
  const Known k = known(GetParam().kind);
  const auto [row, form] = form_named(k.frame, "motor_torque_offset");
  if (row == nullptr) GTEST_SKIP() << "this rig has no torque of a motor";
  const Selection s = undecided(k, *row, *form);
  const auto proposed = next_experiments(k.frame, s);
  ASSERT_EQ(proposed.size(), 1u);
  const double offset = s.accepted.front().trial.fit.model.coefficients.back()[0];
  const double level = middle(k.findings.noise[index_of(Equation::motor)].level);
  EXPECT_NEAR(proposed.front().separation_sigma, offset * std::sqrt(600.0) / level,
              1e-6 * proposed.front().separation_sigma);
  EXPECT_THAT(proposed.front().says, testing::HasSubstr("motor_torque_offset"));
}

// Where two models are one, no recording separates them.
TEST_P(NextMotions, OfOneModelProposeNothing) {
  const Known k = known(GetParam().kind);
  const auto [row, form] = form_named(k.frame, "torque_sensor_drift");
  if (row == nullptr) GTEST_SKIP() << "this rig has no torque sensor";
  Selection s = undecided(k, *row, *form);
  s.accepted.front().rivals.front() = s.accepted.front().trial;
  EXPECT_TRUE(next_experiments(k.frame, s).empty());
}

INSTANTIATE_TEST_SUITE_P(Rigs, NextMotions,
                         testing::Values(PlannedRig{"locked", Rig::locked},
                                         PlannedRig{"free", Rig::free},
                                         PlannedRig{"servo", Rig::servo},
                                         PlannedRig{"specimen", Rig::specimen},
                                         PlannedRig{"joint", data::BenchKind(Rig::specimen, true)}),
                         PrintedName());

}  // namespace
}  // namespace flexspline::studies
