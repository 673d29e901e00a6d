// What errors of the motions do to a model that turns on them.
#include <gtest/gtest.h>

#include "diagnosis/model/motion_error.hpp"
#include "diagnosis/search/search.hpp"
#include "drive_frame.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;

constexpr double kNoise = 0.1;  // Nm
constexpr double kLoss = 2.0;   // Nm
constexpr std::size_t kTorsion = 0;

double width(const Frame& f) { return 0.1 * f.rate_range; }

ArrayXd loss(const Frame& f, const ArrayXd& rate) { return kLoss * (rate / width(f)).tanh(); }

/// A spring with hysteresis tau = K phi + c tanh(v/w), v known to the share given of w.
Frame hysteretic(double error) {
  Frame f = closed_form_frame();
  f.equations = {Equation::torsion};
  f.torque = 2e4 * f.torsion + loss(f, f.torsion_rate) + kNoise * normal(f.rows(), 3);
  f.torque_range = f.torque.abs().maxCoeff();
  f.torsion_rate += error * width(f) * normal(f.rows(), 4);
  return f;
}

TEST(MotionError, IsWhatTheModelChangesByWithinIt) {
  Frame f = hysteretic(0.0);
  const Findings findings = *fit_baseline(f);
  const double s = 0.5 * width(f);
  EXPECT_EQ(torque_of_motion_error(f, findings.fit.model, findings.reference)[kTorsion].size(), 0);
  f.torsion_rate_error = ArrayXd::Constant(f.rows(), s);
  const ArrayXd torque =
      torque_of_motion_error(f, findings.fit.model, findings.reference)[kTorsion];
  const ArrayXd law = 0.5 * (loss(f, f.torsion_rate + s) - loss(f, f.torsion_rate - s));
  // The law is a mixture of a few widths, fitted to noise: a twentieth of what it turns by.
  EXPECT_LT((torque - law).abs().maxCoeff(), 0.05 * kLoss);
  EXPECT_GT(torque.maxCoeff(), 0.4 * kLoss) << "tanh(1/2) where the rate is zero";
}

// To a tenth: over an error of half the width the law is no straight line.
TEST(MotionError, IsNoNoise) {
  const double error = 0.5;
  Frame f = hysteretic(error);
  const Findings blind = *fit_baseline(f);
  f.torsion_rate_error = ArrayXd::Constant(f.rows(), error * width(f));
  const Findings findings = *fit_baseline(f);
  for (std::size_t i = 0; i < f.segments.size(); ++i) {
    EXPECT_GT(blind.noise[kTorsion].level[i], 1.5 * kNoise);
    EXPECT_NEAR(findings.noise[kTorsion].level[i], kNoise, 0.1 * kNoise);
  }
  // Where the rate turns, the rows weigh by what is known there.
  const ArrayXd turns = (f.torsion_rate.abs() < width(f)).cast<double>();
  const ArrayXd over = findings.fit.residual[kTorsion] * findings.weight[kTorsion];
  EXPECT_NEAR((over.square() * turns).sum() / turns.sum(), 1.0, 0.3);
}

/// What a model of a drive in closed form loses by errors of its motions, of one equation.
ArrayXd lost_of(const Frame& f, Equation equation) {
  const Findings findings = *fit_baseline(f);
  return torque_of_motion_error(f, findings.fit.model, findings.reference)[index_of(equation)];
}

/// A free drive with viscous friction and some noise, its rate known exactly.
Frame noisy_drive() {
  Frame f = closed_form_frame();
  f.torque += kNoise * normal(f.rows(), 8);
  f.motor_torque = f.motor_inertia * f.motor_acceleration + f.torque / f.ratio +
                   0.1 * f.motor_speed / f.speed_range + kNoise / f.ratio * normal(f.rows(), 9);
  f.torsion_rate_error = ArrayXd::Zero(f.rows());
  return f;
}

// J1 s of the motor's acceleration, J2 s of the load's, each of its own equation alone.
TEST(MotionError, OfAnAccelerationIsThatOfItsInertia) {
  Frame f = noisy_drive();
  f.motor_acceleration_error = ArrayXd::LinSpaced(f.rows(), 1.0, 7.0);
  f.load_acceleration_error = ArrayXd::Constant(f.rows(), 0.3);
  const ArrayXd motor = lost_of(f, Equation::motor);
  EXPECT_LT((motor - f.motor_inertia * f.motor_acceleration_error).abs().maxCoeff(), 1e-9);
  EXPECT_LT((lost_of(f, Equation::load) - f.load_inertia * 0.3).abs().maxCoeff(), 1e-9);
  EXPECT_LT(lost_of(f, Equation::torsion).maxCoeff(), 1e-9);
}

// Of the torsion what its spring makes of it.
TEST(MotionError, OfATorsionIsThatOfItsSpring) {
  Frame f = hysteretic(0.0);
  f.torsion_rate_error = ArrayXd::Zero(f.rows());
  f.torsion_error = ArrayXd::LinSpaced(f.rows(), 0.0, 1e-3 * f.torsion_range);
  const ArrayXd expected = 2e4 * f.torsion_error;
  EXPECT_LT((lost_of(f, Equation::torsion) - expected).abs().maxCoeff(), 0.05 * expected.maxCoeff())
      << "the slope of the spring is fitted to noise";
}

// Independent errors add up by their squares.
TEST(MotionError, OfSpeedAndAccelerationAddUp) {
  Frame f = noisy_drive();
  f.motor_speed_error = ArrayXd::Constant(f.rows(), 0.01 * f.speed_range);
  const ArrayXd of_speed = lost_of(f, Equation::motor);
  EXPECT_GT(of_speed.maxCoeff(), 0.0);
  f.motor_acceleration_error = ArrayXd::Constant(f.rows(), 5.0);
  const ArrayXd of_both = lost_of(f, Equation::motor);
  const ArrayXd sum = (of_speed.square() + std::pow(f.motor_inertia * 5.0, 2.0)).sqrt();
  EXPECT_LT((of_both - sum).abs().maxCoeff(), 0.02 * sum.maxCoeff()) << "fitted to other weights";
}

// Motor and pendulum turn as one: the last coefficient of the baseline is the inertia of both.
TEST(MotionError, OfAServoIsThatOfBothInertias) {
  const Frame f = drawn_frame(Rig::servo);
  ASSERT_GT(f.load_acceleration_error.maxCoeff(), 0.0);
  const Findings findings = *fit_baseline(f);
  const auto motor = index_of(Equation::motor);
  const Eigen::VectorXd& own = findings.fit.model.own[motor];
  const ArrayXd torque = torque_of_motion_error(f, findings.fit.model, findings.reference)[motor];
  const ArrayXd expected = own[own.size() - 1] * f.load_acceleration_error;
  EXPECT_LT((torque - expected).abs().maxCoeff(), 1e-9 * expected.maxCoeff());
}

}  // namespace
}  // namespace flexspline::studies
