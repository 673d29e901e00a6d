// What a motor equation leaves of a ripple of the motor's torque: a motor in a position loop,
// before an elastic gear and a load, integrated, against the forms of motor_torque_ripple.
#include <cmath>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "diagnosis/model/cause.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr double kRatio = 50.0, kMotor = 6e-4, kLoad = 7e-4;  // kg m^2, at the motor's shaft
constexpr double kGear = 5.0, kGearDamping = 4e-3;            // Nm/rad, Nm/(rad/s), there too
constexpr double kGain = 0.09, kStiffness = 3.0;              // of the loop
constexpr double kRipple = 0.05, kOrder = 4.0;                // Nm, of a turn
constexpr double kSample = 0.01, kFine = 2e-5;                // s
constexpr Index kRows = 12000;

double reference_angle(double t) { return 300.0 * std::sin(0.06 * t); }
double reference_speed(double t) { return 18.0 * std::cos(0.06 * t); }
double reference_acceleration(double t) { return -1.08 * std::sin(0.06 * t); }

/// Motor and load, both at the motor's shaft.
struct State {
  double motor = 0.0, motor_speed = 18.0, load = 0.0, load_speed = 18.0;

  double loop(double t) const {
    return kStiffness * (reference_angle(t) - motor) + kGain * (reference_speed(t) - motor_speed);
  }
  double gear() const { return kGear * (motor - load) + kGearDamping * (motor_speed - load_speed); }
  double motor_acceleration(double t, double loop_share, double feed) const {
    return (loop_share * loop(t) + feed - gear() - kRipple * std::sin(kOrder * motor)) / kMotor;
  }
};

struct Turned {
  ArrayXd time{kRows}, motor{kRows}, motor_speed{kRows}, load{kRows}, load_acceleration{kRows};
  ArrayXd drive{kRows}, gear{kRows}, smooth{kRows};  // torques; the acceleration of the reference
};

// Semi-implicit Euler in steps of which a period of the ripple has thousands. What the reference
// takes is fed forward; without a loop nothing else drives.
Turned turned(bool with_loop) {
  Turned turn;
  State s;
  const double loop_share = with_loop ? 1.0 : 0.0;
  const auto steps = static_cast<int>(std::lround(kSample / kFine));
  double t = 0.0;
  for (Index i = 0; i < kRows; ++i) {
    const double feed = (kMotor + kLoad) * reference_acceleration(t);
    turn.time[i] = t;
    turn.motor[i] = s.motor;
    turn.motor_speed[i] = s.motor_speed;
    turn.load[i] = s.load;
    turn.gear[i] = s.gear();
    turn.load_acceleration[i] = s.gear() / kLoad;
    turn.drive[i] = loop_share * s.loop(t) + feed;
    turn.smooth[i] = reference_acceleration(t);
    for (int k = 0; k < steps; ++k) {
      const double at = t + kFine * k;
      s.motor_speed += kFine * s.motor_acceleration(at, loop_share,
                                                    (kMotor + kLoad) * reference_acceleration(at));
      s.load_speed += kFine * s.gear() / kLoad;
      s.motor += kFine * s.motor_speed;
      s.load += kFine * s.load_speed;
    }
    t = kSample * static_cast<double>(i + 1);
  }
  return turn;
}

/// A frame of that motion whose smoothing keeps what is slower than a bandwidth.
Frame frame_of(const Turned& turn, Rig rig, double bandwidth) {
  Frame frame;
  frame.rig = rig;
  frame.ratio = kRatio;
  frame.motor_inertia = kMotor;
  frame.load_inertia = kLoad * kRatio * kRatio;
  frame.load_mass = frame.load_inertia;
  frame.arm_length = 1.0;
  frame.equations = {Equation::motor};
  frame.time = turn.time;
  frame.motor_angle = rig == Rig::servo ? turn.load : turn.motor;
  frame.motor_speed = turn.motor_speed;
  frame.speed_range = 18.0;
  frame.motor_bandwidth = ArrayXd::Constant(kRows, bandwidth);
  frame.torque = kRatio * turn.gear;
  frame.torque_range = frame.torque.abs().maxCoeff();
  frame.torsion_range = frame.torque_range / (kGear * kRatio * kRatio);
  frame.smooth_motor_torque = turn.drive;
  frame.segments = {{"turn", 0, kRows}};
  return frame;
}

const CauseForm& form_of(const Frame& frame, std::size_t shapes) {
  for (const CauseRow& row : causes()) {
    if (row.id != "motor_torque_ripple") continue;
    for (const CauseForm* form : forms_on(row, frame)) {
      if (form->terms(frame).front().unit == "Nm" && form->shapes(frame).size() == shapes)
        return *form;
    }
  }
  throw std::logic_error("no form has so many shapes");
}

/// Coefficients by least squares beside a constant, and the share of the variance that they leave.
struct Fit {
  Eigen::Vector2d coefficients;
  double left = 0.0;
};

Fit fit(const Frame& frame, const ArrayXd& residual, const std::vector<double>& shape) {
  const auto columns = form_of(frame, shape.size()).columns(Equation::motor, frame, {}, shape);
  Eigen::MatrixXd a(kRows, 3);
  a << columns[0].matrix(), columns[1].matrix(), Eigen::VectorXd::Ones(kRows);
  const Eigen::VectorXd y = (residual - residual.mean()).matrix();
  const Eigen::VectorXd b = a.colPivHouseholderQr().solve(y);
  return {b.head(2), (y - a * b).squaredNorm() / y.squaredNorm()};
}

// The forms leave the gear's damping out, which is 0.044 of the loop's.
constexpr double kUndamped = 0.05;
constexpr double kRate = kGain / (kMotor + kLoad) / kOrder;  // rad/s of the motor
const double kLoopDamping = 0.5 * kGain / std::sqrt(kStiffness * (kMotor + kLoad));

class LeftOfRipple : public testing::Test {
 protected:
  static void SetUpTestSuite() { turn_ = std::make_unique<Turned>(turned(true)); }
  static void TearDownTestSuite() { turn_.reset(); }

  // What the loop's torque shows beside the acceleration that smoothing keeps of the load.
  static Fit of_servo(double bandwidth, const ArrayXd& acceleration, bool plain = false) {
    const Frame frame = frame_of(*turn_, Rig::servo, bandwidth);
    const double windup = frame.torque_range / (kGear * kRatio);
    const ArrayXd residual = turn_->drive - (kMotor + kLoad) * acceleration;
    if (plain) return fit(frame, residual, {kOrder});
    return fit(frame, residual, {kOrder, kRate, kLoopDamping, windup});
  }

  static std::unique_ptr<Turned> turn_;
};

std::unique_ptr<Turned> LeftOfRipple::turn_;

TEST_F(LeftOfRipple, IsTheLoopsAnswerWhereSmoothingKeepsNothing) {
  const Fit form = of_servo(0.1, turn_->smooth);
  EXPECT_NEAR(form.coefficients[0], kRipple, kUndamped * kRipple);
  EXPECT_NEAR(form.coefficients[1], 0.0, kUndamped * kRipple);
  EXPECT_LT(form.left, kUndamped);
  EXPECT_GT(of_servo(0.1, turn_->smooth, true).left, 3.0 * form.left);
}

TEST_F(LeftOfRipple, HasTheLoadsAccelerationWhereSmoothingKeepsIt) {
  const Fit form = of_servo(1e6, turn_->load_acceleration);
  EXPECT_NEAR(form.coefficients[0], kRipple, kUndamped * kRipple);
  EXPECT_NEAR(form.coefficients[1], 0.0, kUndamped * kRipple);
  EXPECT_LT(form.left, kUndamped);
}

TEST_F(LeftOfRipple, IsSeenBesideARecordedGear) {
  const Frame frame = frame_of(*turn_, Rig::free, 0.1);
  const ArrayXd residual = turn_->drive - kMotor * turn_->smooth - turn_->gear;
  const Fit form = fit(frame, residual, {kOrder, kRate, kLoopDamping});
  EXPECT_NEAR(form.coefficients[0], kRipple, kUndamped * kRipple);
  EXPECT_NEAR(form.coefficients[1], 0.0, kUndamped * kRipple);
  EXPECT_LT(form.left, kUndamped);
  EXPECT_GT(fit(frame, residual, {kOrder}).left, 3.0 * form.left);
}

TEST_F(LeftOfRipple, IsNothingWhereItShowsAboutReversalsAlone) {
  const Frame frame = frame_of(*turn_, Rig::servo, 0.1);
  for (const double corner : {0.01, 1.0}) {
    const double shape[] = {31.0, corner * frame.speed_range, 3.0, 0.01};
    const auto columns = form_of(frame, 4).columns(Equation::motor, frame, {}, shape);
    EXPECT_EQ(columns[0].abs().maxCoeff() > 0.0, corner == 1.0);
  }
}

}  // namespace
}  // namespace flexspline::studies
