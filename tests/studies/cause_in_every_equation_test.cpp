// What changes an angle changes every equation that the angle has a part in.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "diagnosis/model/cause.hpp"
#include "drive_frame.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;

const CauseForm& form_on(const Frame& frame, std::string_view id) {
  const CauseRow& row = *std::ranges::find(causes(), id, &CauseRow::id);
  return *forms_on(row, frame).front();
}

// Power that the error takes from the torsion's side is power of the motor.
TEST(KinematicError, DoesNoWorkOfItsOwn) {
  const Frame before = closed_form_frame();
  Frame after = before;
  const std::vector<double> shape = {3e-4, -1e-4, 5e-5, 2e-5, -4e-5, 1e-4};
  const CauseForm& form = form_on(before, "kinematic_error");
  form.transform(after, shape);
  EXPECT_TRUE(std::ranges::count(form.at, Equation::motor));
  const ArrayXd wound = before.torque * (after.torsion_rate - before.torsion_rate);
  const ArrayXd turned = (after.motor_torque - before.motor_torque) * before.motor_speed;
  ASSERT_GT(wound.abs().maxCoeff(), 0.01);
  EXPECT_LT((wound + turned).abs().maxCoeff(), 1e-12 * wound.abs().maxCoeff());
}

// A load's angle that is read late by d, put right, is that of the drive: theta_l(t + d) - d
// theta_l' is theta_l(t) but for (d w)^2/2 of it.
TEST(EncoderSkew, IsLateInTheLoadsEquationToo) {
  constexpr double kLate = 2e-3;  // the interval
  const Frame drive = closed_form_frame();
  Frame read = drive;
  for (const Segment& s : drive.segments) {
    for (auto* x : {&read.load_speed, &read.load_acceleration})
      x->segment(s.first + 1, s.count - 1) = ArrayXd(x->segment(s.first, s.count - 1));
  }
  const auto off = [&](const ArrayXd& x, const ArrayXd& truth) {
    double most = 0.0;
    for (const Segment& s : drive.segments) {
      const auto inner = Eigen::seqN(s.first + 2, s.count - 4);
      most = std::max(most, (x(inner) - truth(inner)).abs().maxCoeff());
    }
    return most;
  };
  const double late = off(read.load_acceleration, drive.load_acceleration);
  const CauseForm& form = form_on(read, "encoder_skew");
  EXPECT_TRUE(std::ranges::count(form.at, Equation::load));
  form.transform(read, std::vector{kLate});
  EXPECT_LT(off(read.load_acceleration, drive.load_acceleration), 1e-9 * late);
  const double fastest = 1.7 * 3.7 * 2.1;  // of closed_form_frame, rad/s
  EXPECT_LT(off(read.load_speed, drive.load_speed),
            0.6 * std::pow(kLate * fastest, 2) * drive.load_speed.abs().maxCoeff());
}

}  // namespace
}  // namespace flexspline::studies
