// A motor that follows a ripple: what a smoothed acceleration leaves of it, against a motor whose
// equation is integrated.
#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "diagnosis/model/cause.hpp"
#include "diagnosis/model/model.hpp"
#include "flexspline/core/rig_residuals.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr double kInertia = 1e-3, kDamping = 2e-3, kRipple = 0.05, kOrder = 4.0;
constexpr double kSample = 0.01;
constexpr int kSteps = 200;  // of the integration in a sample

double torque(double t) { return 0.105 * std::sin(2.0 * t); }

// J w' = tau - B w - A sin(k theta), by the midpoint rule, sampled with an encoder's small error.
Recording turned() {
  Recording recording;
  recording.id = "turn";
  double theta = 0.0, speed = 0.0;
  const double h = kSample / kSteps;
  const auto rate = [](double t, double x, double w) {
    return (torque(t) - kDamping * w - kRipple * std::sin(kOrder * x)) / kInertia;
  };
  for (int i = 0; i < 2000; ++i) {
    const double t = kSample * i;
    recording.time.push_back(t);
    recording.channels[Quantity::motor_angle].push_back(theta + 2e-3 * std::sin(1e4 * t * t));
    recording.channels[Quantity::motor_torque].push_back(torque(t));
    for (int k = 0; k < kSteps; ++k) {
      const double at = t + h * k;
      const double middle = speed + 0.5 * h * rate(at, theta, speed);
      const double half = theta + 0.5 * h * speed;
      speed += h * rate(at + 0.5 * h, half, middle);
      theta += h * middle;
    }
  }
  return recording;
}

ArrayXd array(const std::vector<double>& x) {
  return Eigen::Map<const ArrayXd>(x.data(), static_cast<Index>(x.size()));
}

/// Amplitude of a ripple by least squares, and the share of the mean square that it leaves.
struct Fit {
  double amplitude = 0.0;
  double left = 0.0;
};

Fit fit(const CauseForm& form, const Frame& frame, const ArrayXd& residual) {
  std::vector<double> shape;
  for (const Shape& one : form.shapes(frame)) shape.push_back(one.lower);
  shape.front() = kOrder;
  const auto columns = form.columns(Equation::motor, frame, {}, shape);
  Eigen::MatrixXd a(frame.rows(), 2);
  a << columns[0].matrix(), columns[1].matrix();
  const Eigen::VectorXd b = a.colPivHouseholderQr().solve(residual.matrix());
  return {b.norm(), (residual.matrix() - a * b).squaredNorm() / residual.matrix().squaredNorm()};
}

TEST(FollowedRipple, IsWhatTheSmoothedAccelerationLeaves) {
  const auto channels = drive_channels(Rig::servo, {}, turned());
  ASSERT_TRUE(channels) << channels.error().message();
  Frame frame;
  frame.rig = Rig::free;
  frame.ratio = 50.0;
  frame.motor_inertia = kInertia;
  frame.torque_range = 1.0;
  frame.equations = {Equation::motor};
  frame.motor_angle = array(channels->motor_angle);
  frame.motor_speed = array(channels->motor_speed);
  frame.motor_bandwidth = ArrayXd::Constant(frame.motor_angle.size(), channels->motor_bandwidth);
  frame.speed_range = frame.motor_speed.abs().maxCoeff();
  frame.time = array(channels->time);
  frame.segments = {{"turn", 0, frame.time.size()}};
  ASSERT_GT(kOrder * frame.motor_speed.maxCoeff(), 1.3 * channels->motor_bandwidth)
      << "the ripple has to be too fast for the smoothing";
  const ArrayXd residual = array(channels->motor_torque) -
                           kInertia * array(channels->motor_acceleration) -
                           kDamping * frame.motor_speed;
  const CauseRow* row = nullptr;
  for (const CauseRow& one : causes()) row = one.id == "motor_torque_ripple" ? &one : row;
  ASSERT_NE(row, nullptr);
  std::vector<Fit> fits;
  for (const CauseForm* form : forms_on(*row, frame)) {
    const bool of_loop = form->shapes(frame).size() == 3U;  // as slow as they come: none
    if (form->terms(frame).front().unit != "Nm" || (form->shapes(frame).size() > 1U && !of_loop))
      continue;
    fits.push_back(fit(*form, frame, residual));
  }
  ASSERT_EQ(fits.size(), 2U) << "all of it, and what is followed";
  EXPECT_NEAR(fits[1].amplitude, kRipple, 0.1 * kRipple) << "H is of first order in the penalty";
  EXPECT_LT(fits[1].left, 0.5 * fits[0].left) << "most of what is left is the form's, not noise";
}

}  // namespace
}  // namespace flexspline::studies
