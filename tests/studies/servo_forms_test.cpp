// What a servo's one encoder, at its arm, and its late motor torque ask of the model: closed forms.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "diagnosis/model/cause_columns.hpp"
#include "diagnosis/search/selection.hpp"
#include "drive_frame.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;

constexpr double kNoise = 1e-3;  // of the largest torque

/// Takes an angle of the arm with its rates; the motor turns as the arm does.
void turn(Frame& f, const ArrayXd& angle, const ArrayXd& speed, const ArrayXd& acceleration) {
  f.load_angle = angle, f.load_speed = speed, f.load_acceleration = acceleration;
  f.motor_angle = f.ratio * angle;
  f.motor_speed = f.ratio * speed;
  f.motor_acceleration = f.ratio * acceleration;
  f.hang_pendulum();
}

/// A pendulum of 0.5 kg at 0.2 m, driven with viscous friction alone.
Frame servo_frame() {
  Frame f = closed_form_frame(8000);
  f.rig = Rig::servo;
  f.equations = {Equation::motor};
  f.load_mass = 0.5;
  f.arm_length = 0.2;
  f.torsion.setZero(), f.torsion_rate.setZero(), f.torsion_acceleration.setZero();
  turn(f, f.load_angle, f.load_speed, f.load_acceleration);
  f.speed_range = f.motor_speed.abs().maxCoeff();
  f.torque_range = f.torque.abs().maxCoeff();
  return f;
}

ArrayXd asked_of_motor(const Frame& f) { return f.torque / f.ratio + 2e-5 * f.motor_speed; }

void record(Frame& f, const ArrayXd& torque) {
  f.smooth_motor_torque = torque;
  f.motor_torque_rate = rate_of(f, torque);
  f.motor_torque = torque + kNoise * torque.abs().maxCoeff() * normal(f.rows(), 5);
}

Selection selected(const Frame& f) {
  auto selection = select_causes(f, Limits{}, nullptr);
  EXPECT_TRUE(selection.has_value()) << (selection ? "" : selection.error().message());
  return selection ? *std::move(selection) : Selection{};
}

/// Where a row stands in a model, or past its end.
std::size_t place_of(const DriveModel& model, std::string_view id) {
  return static_cast<std::size_t>(
      std::ranges::find(model.causes, id, [](const ActiveCause& c) { return c.row->id; }) -
      model.causes.begin());
}

std::vector<std::string_view> named_in(const Selection& s) {
  std::vector<std::string_view> ids;
  for (const Accepted& a : s.accepted) {
    if (a.material) ids.push_back(a.trial.cause.row->id);
  }
  return ids;
}

const CauseRow& row_of(std::string_view id) {
  for (const auto rows : {causes(), baseline_parts()}) {
    const auto found = std::ranges::find(rows, id, &CauseRow::id);
    if (found != rows.end()) return *found;
  }
  throw std::invalid_argument(std::string(id));
}

void extend(const Frame& f, Findings& findings, std::string_view id, std::vector<double> shape) {
  const CauseRow& row = row_of(id);
  const ActiveCause cause{&row, forms_on(row, f).front(), std::move(shape)};
  auto fit = extended(f, findings, cause, 20);
  ASSERT_TRUE(fit.has_value()) << fit.error().message();
  findings.fit = *std::move(fit);
}

constexpr double kCompliance = 4e-3;  // rad/Nm

Frame wound_up_frame() {
  Frame f = servo_frame();
  const ArrayXd motor = f.ratio * (f.load_angle + kCompliance * f.torque);
  record(f, asked_of_motor(f) + 0.05 * asked_of_motor(f).abs().maxCoeff() * (2.0 * motor).sin());
  return f;
}

TEST(WindUp, IsToldByARippleOfTheMotor) {
  const Frame f = wound_up_frame();
  auto findings = fit_baseline(f);
  ASSERT_TRUE(findings.has_value());
  extend(f, *findings, "motor_torque_ripple", {2.0});
  const double before = chi_square(f, *findings, findings->fit);
  extend(f, *findings, "wind_up", {1e-4, 1.0});
  EXPECT_LT(chi_square(f, *findings, findings->fit), 0.1 * before);
  EXPECT_NEAR(findings->fit.model.causes.back().shape[0], kCompliance, 0.03 * kCompliance);
}

TEST(WindUp, IsNoName) {
  const Selection s = selected(wound_up_frame());
  EXPECT_EQ(named_in(s), std::vector<std::string_view>{"motor_torque_ripple"});
  EXPECT_LT(place_of(s.final.fit.model, "wind_up"), s.final.fit.model.causes.size());
}

TEST(EncoderEccentricity, OfAServoIsTheArmsAngleThatWasRead) {
  constexpr double kAmplitude = 0.02, kPhase = 0.7;
  Frame f = servo_frame();
  record(f, asked_of_motor(f));
  const ArrayXd phase = f.load_angle + kPhase;
  turn(f, f.load_angle + kAmplitude * phase.sin(), f.load_speed * (1.0 + kAmplitude * phase.cos()),
       f.load_acceleration * (1.0 + kAmplitude * phase.cos()) -
           kAmplitude * f.load_speed.square() * phase.sin());
  const Selection s = selected(f);
  EXPECT_EQ(named_in(s), std::vector<std::string_view>{"encoder_eccentricity"});
  const DriveModel& model = s.final.fit.model;
  const std::size_t at = place_of(model, "encoder_eccentricity");
  ASSERT_LT(at, model.causes.size());
  const auto& shape = model.causes[at].shape;
  EXPECT_NEAR(shape[0], kAmplitude * std::cos(kPhase), 0.05 * kAmplitude);
  EXPECT_NEAR(shape[1], kAmplitude * std::sin(kPhase), 0.05 * kAmplitude);
}

// Half a radian of the fastest motion: a series in T says little there, the law's own rate all.
TEST(CurrentLag, OfALongFilterIsTheRateThatTheLawsAskFor) {
  constexpr double kTime = 0.04;
  Frame f = servo_frame();
  const ArrayXd asked = asked_of_motor(f);
  record(f, asked + kTime * rate_of(f, asked));
  const Selection s = selected(f);
  EXPECT_EQ(named_in(s), std::vector<std::string_view>{"current_lag"});
  const DriveModel& model = s.final.fit.model;
  const std::size_t at = place_of(model, "current_lag");
  ASSERT_LT(at, model.causes.size());
  EXPECT_TRUE(model.causes[at].form->trails);
  EXPECT_NEAR(model.coefficients[at][0], kTime, 0.02 * kTime);
}

}  // namespace
}  // namespace flexspline::studies
