// A ripple of the motor's torque behind a speed loop, against the loop's equation integrated: the
// form is its answer while the speed changes slowly.
#include <cmath>
#include <initializer_list>
#include <stdexcept>
#include <string_view>

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "diagnosis/cause.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr double kInertia = 1e-3, kGain = 0.05, kRipple = 0.04, kOrder = 4.0;
// Of first order in what the speed changes while the loop answers, k theta''/w^2 with w = G/J:
// 0.029.
constexpr double kQuasiStatic = 0.03;
constexpr double kSample = 0.01;
constexpr int kRows = 3000, kSteps = 100;  // samples, and steps of the integration in each

double reference_speed(double t) { return 30.0 * std::sin(0.6 * t); }

/// Of a recording: where the motor is, how fast, and what its loop adds to the reference's torque.
struct Turned {
  ArrayXd angle{kRows}, speed{kRows}, torque{kRows};
};

// J w' = J w_r' + G (w_r - w) - A sin(k theta), by the midpoint rule.
Turned turned() {
  Turned turn;
  double theta = 0.0, error = 0.0;  // error: w - w_r
  const double h = kSample / kSteps;
  const auto rate = [](double x, double e) {
    return (-kGain * e - kRipple * std::sin(kOrder * x)) / kInertia;
  };
  for (Index i = 0; i < kRows; ++i) {
    const double t = kSample * static_cast<double>(i);
    turn.angle[i] = theta;
    turn.speed[i] = reference_speed(t);
    turn.torque[i] = -kGain * error;
    for (int k = 0; k < kSteps; ++k) {
      const double at = t + h * k;
      const double middle = error + 0.5 * h * rate(theta, error);
      const double half = theta + 0.5 * h * (reference_speed(at) + error);
      error += h * rate(half, middle);
      theta += h * (reference_speed(at + 0.5 * h) + middle);
    }
  }
  return turn;
}

const CauseForm& form_with(std::string_view shape, const Frame& frame) {
  for (const CauseRow& row : causes()) {
    if (row.id != "motor_torque_ripple") continue;
    for (const CauseForm* form : forms_on(row, frame)) {
      if (form->shapes(frame).back().name == shape) return *form;
    }
  }
  throw std::logic_error("no form has that shape");
}

/// Coefficients by least squares, and the share of the mean square that they leave.
struct Fit {
  Eigen::Vector2d coefficients;
  double left = 0.0;
};

Fit fit(const CauseForm& form, const Frame& frame, const ArrayXd& torque,
        std::initializer_list<double> shape) {
  const auto columns = form.columns(Equation::motor, frame, {}, {shape.begin(), shape.size()});
  Eigen::MatrixXd a(frame.rows(), 2);
  a << columns[0].matrix(), columns[1].matrix();
  const Eigen::VectorXd y = torque.matrix();
  const Eigen::Vector2d b = a.colPivHouseholderQr().solve(y);
  return {b, (y - a * b).squaredNorm() / y.squaredNorm()};
}

TEST(AnsweredRipple, IsWhatASpeedLoopLetsThrough) {
  const Turned turn = turned();
  Frame frame;
  frame.rig = Rig::servo;
  frame.ratio = 50.0;
  frame.equations = {Equation::motor};
  frame.motor_angle = turn.angle;
  frame.motor_speed = turn.speed;
  frame.speed_range = turn.speed.abs().maxCoeff();
  frame.time = kSample * ArrayXd::LinSpaced(kRows, 0.0, kRows - 1.0);
  const double corner = kGain / kInertia / kOrder;  // rad/s of the motor
  ASSERT_GT(frame.speed_range, 2.0 * corner) << "the ripple has to be too fast for the loop";
  const Fit plain = fit(form_with("order", frame), frame, turn.torque, {kOrder});
  const Fit answered = fit(form_with("corner_speed", frame), frame, turn.torque, {kOrder, corner});
  EXPECT_NEAR(answered.coefficients[0], kRipple, kQuasiStatic * kRipple);
  EXPECT_NEAR(answered.coefficients[1], 0.0, kQuasiStatic * kRipple);
  EXPECT_LT(answered.left, 0.02);
  EXPECT_GT(plain.left, 0.3) << "a ripple of constant amplitude is not what a loop lets through";
}

}  // namespace
}  // namespace flexspline::studies
