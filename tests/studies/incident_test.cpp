#include <cmath>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "autoregression.hpp"
#include "diagnosis/search/incident.hpp"
#include "diagnosis/search/step_incident.hpp"
#include "drive_frame.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

/// The load's equation alone, with white noise and this beside its law.
Frame with_load(Frame frame, const ArrayXd& what) {
  const double level = 0.005 * frame.largest_torque(Equation::load);
  frame.equations = {Equation::load};
  frame.torque = frame.load_inertia * frame.load_acceleration + 0.5 * frame.load_speed +
                 level * coloured_noise(frame.rows(), 0.0, 21) + what;
  return frame;
}

std::optional<Incident> incident_of(const Frame& frame, const ArrayXd& what) {
  const Frame measured = with_load(frame, what);
  return find_incident(measured, *fit_baseline(measured), {});
}

struct Case {
  Index first, count;
  double height;  ///< of the largest torque; 0: white noise of five times the level
};

TEST(Incident, ABurstAPulseAndAStepAreFoundWhereTheyAre) {
  const Frame frame = closed_form_frame(6000);
  const double torque = frame.largest_torque(Equation::load);
  for (const Case& one : {Case{3500, 300, 0.0}, Case{1200, 30, 0.03}, Case{4500, 1500, 0.02}}) {
    ArrayXd what = ArrayXd::Zero(frame.rows());
    auto part = what.segment(one.first, one.count);
    part = one.height > 0.0 ? ArrayXd::Constant(one.count, one.height * torque)
                            : ArrayXd(0.025 * torque * coloured_noise(one.count, 0.0, 5));
    const auto found = incident_of(frame, what);
    ASSERT_TRUE(found.has_value()) << one.first;
    EXPECT_EQ(found->equation, Equation::load);
    EXPECT_EQ(found->segment, one.first < 3000 ? 0U : 1U);
    const Index from = std::max(found->first, one.first);
    const Index to = std::min(found->first + found->count, one.first + one.count);
    EXPECT_GT(to - from, std::min<Index>(one.count, 100) * 8 / 10) << one.first;
    const Frame rest = without_incident(frame, *found);
    EXPECT_EQ(rest.usable.segment(found->first, found->count).maxCoeff(), 0.0);
    EXPECT_EQ(rest.incidents.size(), 1U);
  }
}

TEST(Incident, NoiseHasNoneNorHasWhatEveryRecordingHas) {
  const Frame frame = closed_form_frame(6000);
  EXPECT_FALSE(incident_of(frame, ArrayXd::Zero(frame.rows())));
  ArrayXd both = ArrayXd::Zero(frame.rows());
  const double torque = frame.largest_torque(Equation::load);
  for (const Index first : {1000, 4000}) both.segment(first, 200).setConstant(0.03 * torque);
  EXPECT_FALSE(incident_of(frame, both));
}

// Most of a recording lies behind it: its own size is no unit to measure it in.
TEST(Incident, AStepThatLastsForMostOfARecordingIsFound) {
  const Frame frame = closed_form_frame(6000);
  ArrayXd what = ArrayXd::Zero(frame.rows());
  what.segment(3600, 2400).setConstant(0.05 * frame.largest_torque(Equation::load));
  const auto found = incident_of(frame, what);
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(static_cast<double>(found->first), 3600.0, 5.0);
  EXPECT_EQ(found->first + found->count, frame.rows());
}

/// Corners of the motion at these rows.
Frame with_corners(Frame frame, const std::vector<Index>& rows) {
  const double jump = 10.0 * frame.motor_acceleration.abs().maxCoeff();
  for (const Index row : rows) frame.motor_acceleration[row] += jump;
  return frame;
}

TEST(Incident, WhatEveryCornerMissesIsNoneAndAPulseAtOneOfThemIs) {
  const std::vector<Index> corners = {500, 1100, 1900, 2500, 3600, 4400, 5200};
  Frame frame = with_corners(closed_form_frame(6000), corners);
  frame.motor_acceleration[1900] *= 2.0;  // sharper than that with the pulse
  const double torque = frame.largest_torque(Equation::load);
  ArrayXd at_all = ArrayXd::Zero(frame.rows());
  for (const Index row : corners) at_all.segment(row - 10, 20).setConstant(0.03 * torque);
  EXPECT_FALSE(incident_of(frame, at_all));
  ArrayXd at_one = ArrayXd::Zero(frame.rows());
  at_one.segment(4385, 30).setConstant(0.06 * torque);
  const auto found = incident_of(frame, at_one);
  ASSERT_TRUE(found.has_value());
  EXPECT_LE(found->first, 4400);
  EXPECT_GE(found->first + found->count, 4400);
}

TEST(Incident, WhatStandsAtTheSharpestCornerOfAllIsNone) {
  Frame frame = with_corners(closed_form_frame(6000), {1900, 4400});
  frame.motor_acceleration[4400] *= 2.0;
  ArrayXd what = ArrayXd::Zero(frame.rows());
  what.segment(4391, 18).setConstant(0.06 * frame.largest_torque(Equation::load));
  EXPECT_FALSE(incident_of(frame, what));
}

// The gain of a step beside the law's only column, in closed form.
TEST(Incident, AStepGainsWhatTheLawDoesNotTakeOfIt) {
  Frame frame = closed_form_frame(6000);
  ArrayXd what = ArrayXd::Zero(frame.rows());
  what.segment(4700, 1300).setConstant(0.01 * frame.largest_torque(Equation::load));
  frame = with_load(frame, what);
  const Findings findings = *fit_baseline(frame);
  const auto step_found = step_taken(frame, findings, Equation::load, {});
  ASSERT_TRUE(step_found);
  EXPECT_EQ(step_found->segment, 1U);
  EXPECT_NEAR(static_cast<double>(step_found->first), 1700.0, 30.0);
  const std::size_t e = index_of(Equation::load);
  const ArrayXd& weight = findings.weight[e];
  const Eigen::VectorXd law = (frame.load_speed * weight).matrix().normalized();
  Eigen::VectorXd step = Eigen::VectorXd::Zero(frame.rows());
  const Index from = frame.segments[1].first + step_found->first;
  step.tail(frame.rows() - from) = weight.tail(frame.rows() - from).matrix();
  step -= law * law.dot(step);
  const Eigen::VectorXd z = (findings.fit.residual[e] * weight).matrix();
  const double gain = std::pow(step.dot(z), 2) / step.squaredNorm() / findings.noise[e].colour;
  EXPECT_NEAR(2.0 * step_found->nats, gain, 1e-6 * gain);
}

// Slow noise of one recording has a mean from some row on that differs from the one before.
TEST(Incident, WhatWandersInOneRecordingIsNoStep) {
  const Frame frame = closed_form_frame(6000);
  const double torque = frame.largest_torque(Equation::load);
  for (const unsigned seed : {1U, 2U, 3U, 4U, 5U, 6U}) {
    ArrayXd slow = ArrayXd::Zero(frame.rows());
    slow.head(3000) = 0.01 * torque * coloured_noise(3000, 0.99, seed);
    const auto found = incident_of(frame, slow);
    EXPECT_FALSE(found && found->first + found->count == 3000) << seed;
  }
}

// One row in a hundred ten times off, as of a Student t of few degrees.
TEST(Incident, ATailIsNone) {
  const Frame frame = closed_form_frame(6000);
  const double level = 0.005 * frame.largest_torque(Equation::load);
  ArrayXd tails = ArrayXd::Zero(frame.rows());
  const ArrayXd lots = coloured_noise(frame.rows(), 0.0, 6);
  tails = (lots > 2.33).select(10.0 * level, (lots < -2.33).select(-10.0 * level, tails));
  EXPECT_FALSE(incident_of(frame, tails));
}

}  // namespace
}  // namespace flexspline::studies
