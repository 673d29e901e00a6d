#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "diagnosis/frame/folds.hpp"
#include "diagnosis/proof/prove.hpp"
#include "diagnosis/search/explanation.hpp"
#include "drive_frame.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

const CauseRow& row_of(std::string_view id) {
  return *std::ranges::find(causes(), id, &CauseRow::id);
}

/// A form that acts on the torsion equation, by columns or by a change of the motion.
Trial trial_of(double size, double change, bool transform) {
  static const CauseForm columns{.equation = "columns", .rigs = {}, .at = {Equation::torsion}};
  static const CauseForm moved{.equation = "moved",
                               .rigs = {},
                               .at = {Equation::torsion},
                               .transform = [](Frame&, std::span<const double>) {}};
  Trial trial;
  trial.cause = {&row_of("presliding_hysteresis"), transform ? &moved : &columns, {}};
  trial.size = size;
  trial.change = change;
  return trial;
}

TEST(TakenUp, IsWhatIsLargeAndMovesThePredictionByLess) {
  const Limits limits;
  const double large = 1.2 * limits.half;
  EXPECT_TRUE(is_taken_up(trial_of(large, 0.5 * large, false), limits));
  const double nearly_all = limits.alike() * large;
  EXPECT_TRUE(is_taken_up(trial_of(large, 0.99 * nearly_all, false), limits));
  EXPECT_FALSE(is_taken_up(trial_of(large, 1.01 * nearly_all, false), limits)) << "nearly all";
  EXPECT_FALSE(is_taken_up(trial_of(large, 1.1 * large, false), limits)) << "it is seen in full";
  EXPECT_FALSE(is_taken_up(trial_of(0.9 * limits.half, 0.0, false), limits)) << "small";
  EXPECT_FALSE(is_taken_up(trial_of(large, 0.0, true), limits)) << "no column";
}

Frame three_recordings() {
  Frame f = closed_form_frame(6000);
  f.segments = {{"a", 0, 3000, Split::unassigned},
                {"b", 3000, 1500, Split::unassigned},
                {"c", 4500, 1500, Split::unassigned}};
  return f;
}

TEST(HeldOut, MarksOfTheDataSetDecide) {
  Frame f = three_recordings();
  f.segments[2].split = Split::holdout;
  const ArrayXd held = held_out(f);
  EXPECT_EQ(held.sum(), 1500.0);
  EXPECT_EQ(held.tail(1500).minCoeff(), 1.0);
}

TEST(HeldOut, WithoutMarksOneThatLiesWithinTheReachOfOthers) {
  Frame f = three_recordings();
  const auto shrink = [](ArrayXd& x) { x.segment(3000, 1500) *= 0.1; };
  shrink(f.torsion), shrink(f.torsion_rate), shrink(f.motor_speed), shrink(f.torque);
  const ArrayXd held = held_out(f);
  EXPECT_EQ(held.segment(3000, 1500).minCoeff(), 1.0);
  EXPECT_EQ(held.sum(), 1500.0);
}

// A law that is fitted to 0.97 of a range is not extrapolated over the rest.
TEST(HeldOut, OneThatOthersReachNearlyMayBeItToo) {
  Frame f = three_recordings();
  for (ArrayXd* x : {&f.torsion, &f.torsion_rate, &f.motor_speed, &f.torque}) {
    *x = ArrayXd::Ones(6000);
    x->segment(3000, 1500) *= 1.03;
    x->tail(1500) *= 1.2;
  }
  const ArrayXd held = held_out(f);
  EXPECT_EQ(held.segment(3000, 1500).minCoeff(), 1.0);
  EXPECT_EQ(held.sum(), 1500.0) << "the third reaches too far";
}

// A free f is known on neither side by the other, an odd one on both.
TEST(HeldOut, OfAnAngleThatTravelsWhatTheRestReachesOnThatSide) {
  Frame f = three_recordings();
  for (ArrayXd* x : {&f.torsion_rate, &f.motor_speed, &f.torque}) *x = ArrayXd::Ones(6000);
  f.torsion.head(3000) = ArrayXd::LinSpaced(3000, -0.5, 1.0);
  f.torsion.segment(3000, 1500) = ArrayXd::LinSpaced(1500, -0.9, 0.5);
  f.torsion.tail(1500) = ArrayXd::LinSpaced(1500, -0.4, 0.4);
  f.measure_torsion();
  EXPECT_EQ(held_out(f).sum(), 3000.0);
  f.travels = true;
  EXPECT_EQ(held_out(f).sum(), 1500.0);
  EXPECT_EQ(held_out(f).tail(1500).minCoeff(), 1.0);
}

// Nine recordings, the first of which reaches furthest in everything.
Frame nine_recordings() {
  Frame f = closed_form_frame(9000);
  f.segments.clear();
  for (Index k = 0; k < 9; ++k) f.segments.push_back({"r", 1000 * k, 1000, Split::unassigned});
  for (ArrayXd* x : {&f.torsion, &f.torsion_rate, &f.motor_speed, &f.torque}) {
    *x = ArrayXd::Ones(9000) * 0.5;
    x->head(1000).setOnes();
  }
  return f;
}

// The marked fold is judged; names have the others, too, which a set without marks would have.
TEST(OuterFolds, OfMarkedRecordingsAreAsManyAsOfOthers) {
  Frame f = nine_recordings();
  ASSERT_EQ(outer_folds(f).size(), 3U);
  for (const OuterFold& fold : outer_folds(f)) EXPECT_TRUE(fold.proves);
  f.segments.back().split = Split::holdout;
  const auto folds = outer_folds(f);
  ASSERT_EQ(folds.size(), 3U);
  EXPECT_TRUE(folds[0].proves);
  EXPECT_EQ(folds[0].rows.sum(), 1000.0);
  EXPECT_EQ(folds[0].rows.tail(1000).minCoeff(), 1.0);
  const ArrayXd others = folds[1].rows + folds[2].rows;
  EXPECT_FALSE(folds[1].proves || folds[2].proves);
  EXPECT_EQ(others.segment(1000, 7000).minCoeff(), 1.0);
  EXPECT_EQ(others.sum(), 7000.0) << "neither the marked one nor what reaches furthest";
}

TEST(HeldOut, WithoutMarksEveryOtherRecordingInOneFold) {
  const Frame f = nine_recordings();
  const auto folds = folds_of(f);
  ASSERT_EQ(folds.size(), 3U);  // eight recordings, a third of nine at most in each
  ArrayXd times = ArrayXd::Zero(9000);
  for (const ArrayXd& fold : folds) {
    EXPECT_LE(fold.sum(), 3000.0);
    times += fold;
  }
  EXPECT_EQ(times.head(1000).maxCoeff(), 0.0);
  EXPECT_EQ(times.tail(8000).minCoeff(), 1.0);
  EXPECT_EQ(times.maxCoeff(), 1.0);
}

// No law is fitted to a rate that comes and goes with the motor's turn: it reaches nowhere.
TEST(HeldOut, WhatIsPeriodicInTheMotorsTurnIsNoReach) {
  Frame f = closed_form_frame(9000);
  f.segments.clear();
  for (Index k = 0; k < 9; ++k) f.segments.push_back({"r", 1000 * k, 1000, Split::unassigned});
  for (ArrayXd* x : {&f.torsion, &f.motor_speed, &f.torque}) *x = ArrayXd::Ones(9000);
  ArrayXd rate = ArrayXd::Ones(9000) * 0.5;
  rate.segment(5000, 1000).setOnes();
  f.periodic_rate = ArrayXd::Zero(9000);
  f.periodic_rate.segment(2000, 1000).setConstant(7.0);
  f.torsion_rate = rate + f.periodic_rate;
  const ArrayXd held = held_out(f);
  EXPECT_EQ(held.sum(), 7000.0);
  EXPECT_EQ(held.segment(2000, 1000).minCoeff(), 1.0) << "furthest by its ripple alone";
  EXPECT_EQ(held.segment(5000, 1000).maxCoeff(), 0.0) << "furthest without";
}

// Two recordings, each faster, or further, than the other.
TEST(HeldOut, WhereEachReachesFurthestTheLastThirdOfEach) {
  Frame f = closed_form_frame(6000);
  f.torsion.tail(3000) *= 0.2;
  const ArrayXd held = held_out(f);
  EXPECT_EQ(held.sum(), 2000.0);
  EXPECT_EQ(held.segment(0, 2000).maxCoeff(), 0.0);
  EXPECT_EQ(held.segment(2000, 1000).minCoeff(), 1.0);
  EXPECT_EQ(held.segment(5000, 1000).minCoeff(), 1.0);
}

TEST(HeldOut, OfTheEndsWhatTheRestReaches) {
  Frame f = closed_form_frame(6000);
  f.torsion.tail(3000) *= 0.2;
  const ArrayXd growing = ArrayXd::LinSpaced(3000, 0.0, 1.0);
  f.torque.head(3000) = growing;
  f.torque.tail(3000) = 0.1 * growing;
  const ArrayXd held = held_out(f);
  EXPECT_EQ(held.segment(2000, 90).minCoeff(), 1.0);
  EXPECT_EQ(held.segment(2110, 890).maxCoeff(), 0.0) << "beyond 1.05 of what the rest reaches";
  EXPECT_EQ(held.tail(1000).minCoeff(), 1.0);
}

TEST(Explanation, WhatIsTooSmallForANameIsSomethingLeftAllTheSame) {
  const Limits limits;
  double size = 0.8 * limits.interest;
  const auto left = [&](double gain, double removed, bool beside_a_cause = false) {
    Selection s;
    Accepted small;
    small.trial = trial_of(size, size, false);
    small.trial.net_gain = gain;
    small.trial.removed = removed;
    s.immaterial = {small};
    if (beside_a_cause) s.accepted = {small};
    return left_unnamed(s, limits) != nullptr;
  };
  const double gain = 2.0 * limits.named_gain;
  const double removed = 2.0 * limits.tenth;
  EXPECT_TRUE(left(gain, removed));
  EXPECT_FALSE(left(0.4 * gain, removed)) << "no name would be worth so little";
  EXPECT_FALSE(left(gain, 0.4 * removed)) << "it orders next to nothing";
  EXPECT_FALSE(left(gain, removed, true)) << "it may mend the form of what is named";
  EXPECT_EQ(left_unnamed(Selection{}, limits), nullptr);
  size = 0.4 * limits.interest;
  EXPECT_FALSE(left(gain, removed)) << "two of them would be of no interest";
}

TEST(Forms, OverTheMotorsAngleOfAServoNeedItsGearRatio) {
  Frame f = closed_form_frame(6000);
  f.rig = Rig::servo;
  f.equations = {Equation::motor};
  for (const char* id : {"motor_torque_ripple", "position_dependent_friction"}) {
    EXPECT_FALSE(forms_on(row_of(id), f).empty()) << id;
    Frame unknown = f;
    unknown.ratio = 1.0;
    EXPECT_TRUE(forms_on(row_of(id), unknown).empty()) << id;
  }
}

// A joint whose torque is late shows the motion of then: sin(t) at t - d.
TEST(Forms, LateTorqueOfAJointThatTravelsIsTheMotionOfThen) {
  Frame f = closed_form_frame(6000);
  f.rig = Rig::specimen;
  f.equations = {Equation::torsion};
  f.travels = true;
  f.torsion = f.time.sin();
  f.torsion_rate = f.time.cos();
  f.torsion_acceleration = -f.time.sin();
  f.measure_torsion();
  const auto forms = forms_on(row_of("sensor_delay"), f);
  ASSERT_EQ(forms.size(), 2U) << "a delay, and a delay with a filter behind";
  const double delay = 0.0371;
  Frame late = f;
  forms.front()->transform(late, std::array{delay});
  const Index inside = static_cast<Index>(std::ceil(delay / f.interval));
  for (const Segment& s : f.segments) {
    const auto part = Eigen::seqN(s.first + inside, s.count - inside);
    const ArrayXd then = f.time(part) - delay;
    // Cubic between rows, by a secant at the ends: h^2/2 u (1 - u)^2.
    const double error = f.interval * f.interval * 2.0 / 27.0 * 1.01;
    EXPECT_LT((late.torsion(part) - then.sin()).abs().maxCoeff(), error);
    EXPECT_LT((late.torsion_rate(part) - then.cos()).abs().maxCoeff(), error);
    EXPECT_LT((late.torsion_acceleration(part) + then.sin()).abs().maxCoeff(), error);
  }
}

TEST(TryCauses, DoesNotDependOnTheNumberOfThreads) {
  const Frame frame = drawn_frame(Rig::locked);
  const auto baseline = fit_baseline(frame);
  ASSERT_TRUE(baseline) << baseline.error().message();
  const auto alone = try_causes(frame, *baseline, 1);
  const auto together = try_causes(frame, *baseline, 3);
  ASSERT_FALSE(alone.empty());
  ASSERT_EQ(alone.size(), together.size());
  for (std::size_t i = 0; i < alone.size(); ++i) {
    EXPECT_EQ(alone[i].cause.row, together[i].cause.row);
    EXPECT_EQ(alone[i].gain, together[i].gain);
  }
}

}  // namespace
}  // namespace flexspline::studies
