// A ripple over the motor's angle, found in what a joint's reversals leave alone.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "diagnosis/search/ripple.hpp"
#include "diagnosis/words/spelled.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr double kRatio = 160.0;

/// Two joint recordings of 0.1 and 0.2 rad/s to and fro over 1.2 rad, and a residual of white noise
/// with bursts that many times as large at the reversals.
struct Joint {
  Frame frame;
  Findings findings;

  explicit Joint(double noise, double reversals = 100.0) {
    constexpr Index rows = 6000;
    Frame& f = frame;
    f.rig = Rig::specimen;
    f.travels = true;
    f.ratio = kRatio;
    f.equations = {Equation::torsion};
    f.interval = 0.02;
    f.time = ArrayXd(2 * rows);
    f.torsion = f.torsion_rate = f.time;
    ArrayXd left(2 * rows);
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    for (Index s = 0; s < 2; ++s) {
      const double speed = 0.1 * static_cast<double>(s + 1);
      for (Index i = 0; i < rows; ++i) {
        const Index r = s * rows + i;
        const double t = f.interval * static_cast<double>(i);
        const double stroke = 1.2 / speed;
        const double phase = std::fmod(t, 2.0 * stroke);
        const bool back = phase >= stroke;
        f.time[r] = t;
        f.torsion[r] = speed * (back ? 2.0 * stroke - phase : phase);
        f.torsion_rate[r] = back ? -speed : speed;
        const bool turning = std::fmod(phase + 0.4, stroke) < 0.8;
        left[r] = noise * normal(random) * (turning ? reversals : 1.0);
      }
      f.segments.push_back({s == 0 ? "slow" : "fast", s * rows, rows});
    }
    f.motor_angle = kRatio * f.torsion;
    f.motor_speed = kRatio * f.torsion_rate;
    f.usable = ArrayXd::Ones(2 * rows);
    findings.fit.residual[index_of(Equation::torsion)] = left;
  }

  ArrayXd& residual() { return findings.fit.residual[index_of(Equation::torsion)]; }
  std::optional<Ripple> ripple() const { return ripple_left(frame, findings); }
};

TEST(RippleLeft, IsFoundBesideReversalsThatLeaveMore) {
  Joint joint(0.02);
  joint.residual() += 0.03 * (2.0 * joint.frame.motor_angle + 0.4).sin();
  const auto ripple = joint.ripple();
  ASSERT_TRUE(ripple);
  EXPECT_NEAR(ripple->order, 2.0, 0.02) << "one over the turns of the travel is 0.03";
  EXPECT_NEAR(ripple->amplitude, 0.03, 0.002);
  const double stroke = ripple->segment == 0 ? 12.0 : 6.0;
  EXPECT_NEAR(ripple->to_s - ripple->from_s, stroke, 1.2) << "one stroke, less a window";
}

// A sine's power over that and the noise's.
TEST(RippleLeft, HasTheShareOfASine) {
  Joint joint(0.02, 1.0);
  joint.residual() += 0.03 * (2.0 * joint.frame.motor_angle + 0.4).sin();
  const auto ripple = joint.ripple();
  ASSERT_TRUE(ripple);
  EXPECT_NEAR(ripple->share, 0.5 * 9.0 / (0.5 * 9.0 + 4.0), 0.03);
}

TEST(RippleLeft, MayHaveAnotherPhaseEachWay) {
  Joint joint(0.02);
  const ArrayXd way = joint.frame.motor_speed.sign();
  joint.residual() += 0.03 * (2.0 * joint.frame.motor_angle + 1.2 * way).sin();
  const auto ripple = joint.ripple();
  ASSERT_TRUE(ripple);
  EXPECT_NEAR(ripple->order, 2.0, 0.02);
}

TEST(RippleLeft, IsNoneInNoise) {
  const auto ripple = Joint(0.02).ripple();
  EXPECT_LT(ripple ? ripple->statistic : 0.0, 20.0);
}

TEST(RippleLeft, IsNoneInWhatChangesSlowlyAlongTheTravel) {
  Joint joint(0.001);
  joint.residual() += 0.5 * (3.0 * joint.frame.torsion).sin();
  const auto ripple = joint.ripple();
  EXPECT_LT(ripple ? ripple->statistic : 0.0, 20.0);
}

/// What a diagnosis that found nothing else says of a ripple of this order and amplitude, in the
/// recordings from this one on.
Diagnosis said_of(double order, double amplitude, Index from = 0) {
  Joint joint(0.02, 1.0);
  joint.frame.torque_range = 30.0;
  const Index rows = joint.residual().size() - from;
  joint.residual().tail(rows) +=
      amplitude * (order * joint.frame.motor_angle.tail(rows) + 0.4).sin();
  Selection s;
  s.final = joint.findings;
  Diagnosis d;
  d.tried = {{.effect = "kinematic_error", .round = 1, .outcome = "gains no more than noise would"},
             {.effect = "backlash", .round = 1, .outcome = "gains no more than noise would"}};
  const auto ripple =
      find_ripple(joint.frame, s, {.rmse_after = 1.0, .noise_floor = 1.0}, Limits{});
  EXPECT_TRUE(ripple.has_value());
  if (ripple) spell_ripple(joint.frame, s, *ripple, d);
  return d;
}

TEST(SpellRipple, NamesTheOrdersThatTheCatalogueHas) {
  const Diagnosis d = said_of(2.0, 0.03);
  ASSERT_EQ(d.causes.size(), 1u);
  const Cause& cause = d.causes.front();
  EXPECT_EQ(cause.effect, "kinematic_error");
  EXPECT_NEAR(cause.size_fraction, 0.001, 1e-4);
  EXPECT_EQ(cause.alternatives,
            (std::vector<std::string>{"motor_torque_ripple", "position_dependent_friction"}));
  EXPECT_NEAR(cause.evidence.holdout_rmse_ratio, std::sqrt(4.0 / (0.5 * 9.0 + 4.0)), 0.02)
      << "the noise over both";
  ASSERT_EQ(d.tried.size(), 2u) << "what all of the torque says of it is replaced";
  EXPECT_EQ(d.tried.back().effect, "kinematic_error");
  EXPECT_EQ(d.tried.back().round, 2);
  EXPECT_TRUE(d.tried.back().outcome.starts_with("accepted"));
  ASSERT_EQ(d.mismatch.size(), 1u);
  EXPECT_EQ(d.mismatch.front().coordinate, "motor_angle");
}

TEST(SpellRipple, TellsOtherOrdersWithoutAName) {
  const Diagnosis d = said_of(2.4, 0.03);
  EXPECT_TRUE(d.causes.empty());
  EXPECT_EQ(d.notes.size(), 1u);
  EXPECT_EQ(d.mismatch.size(), 1u);
}

TEST(SpellRipple, NamesNothingThatOneRecordingAloneHas) {
  const Diagnosis d = said_of(2.0, 0.06, 6000);
  EXPECT_TRUE(d.causes.empty());
  EXPECT_EQ(d.notes.size(), 1u);
}

TEST(RippleLeft, IsForAnglesThatTravel) {
  Joint joint(0.02);
  joint.frame.travels = false;
  EXPECT_FALSE(joint.ripple());
}

}  // namespace
}  // namespace flexspline::studies
