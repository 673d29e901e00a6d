// An encoder off centre, of the motor of a free drive: what it reads is not where the motor is.
#include <algorithm>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "active_cause.hpp"
#include "drive_frame.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;

const CauseForm& of_motor(const Frame& frame) {
  for (const CauseForm* form : forms_on(*form_named(frame, "encoder_eccentricity").first, frame)) {
    if (std::ranges::count(form->at, Equation::motor) > 0) return *form;
  }
  throw std::logic_error("no form of the motor's encoder");
}

double change(const ArrayXd& x, const ArrayXd& y) {
  return (x - y).abs().maxCoeff() / x.abs().maxCoeff();
}

// To the second order in the error: it goes by the angle that was read.
TEST(EncoderEccentricity, OfAMotorIsTakenOutOfEveryRate) {
  constexpr double kSine = 4e-6, kCosine = -3e-6;  // rad of the torsion
  const Frame truth = closed_form_frame();
  Frame read = truth;
  const ArrayXd s = truth.motor_angle.sin(), c = truth.motor_angle.cos();
  const ArrayXd e = kSine * s + kCosine * c, first = kSine * c - kCosine * s;
  read.torsion -= e;
  read.torsion_rate -= truth.motor_speed * first;
  read.motor_angle -= truth.ratio * e;
  read.motor_speed -= truth.ratio * truth.motor_speed * first;
  const ArrayXd wrong =
      truth.ratio * (truth.motor_acceleration * first - truth.motor_speed.square() * e);
  read.motor_acceleration -= wrong;
  ASSERT_GT(wrong.abs().maxCoeff(), 0.005 * truth.motor_acceleration.abs().maxCoeff());

  of_motor(truth).transform(read, std::vector{kSine, kCosine});
  EXPECT_LT(change(truth.torsion, read.torsion), 1e-5);
  EXPECT_LT(change(truth.torsion_rate, read.torsion_rate), 1e-3);
  EXPECT_LT(change(truth.motor_angle, read.motor_angle), 1e-7);
  EXPECT_LT(change(truth.motor_speed, read.motor_speed), 1e-6);
  EXPECT_LT((truth.motor_acceleration - read.motor_acceleration).abs().maxCoeff(),
            1e-3 * wrong.abs().maxCoeff());
}

}  // namespace
}  // namespace flexspline::studies
