#include "diagnosis/model/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

std::vector<Shape> amplitudes_to(double most) {
  return {{.name = "sine",
           .unit = "rad",
           .lower = -most,
           .upper = most,
           .logarithmic = false,
           .meaning = "of the error once a turn"},
          {.name = "cosine",
           .unit = "rad",
           .lower = -most,
           .upper = most,
           .logarithmic = false,
           .meaning = "its cosine"}};
}

std::vector<Shape> amplitudes(const Frame& f) { return amplitudes_to(0.5 * f.torsion_range); }

std::vector<Shape> amplitudes_of_arm(const Frame&) {
  constexpr double kMost = 0.1;  // of the effect, rad
  return amplitudes_to(kMost);
}

// theta_l is less than measured by e = a sin theta_l + b cos theta_l.
void runout(Frame& f, Values shape) {
  const ArrayXd s = f.load_angle.sin();
  const ArrayXd c = f.load_angle.cos();
  const ArrayXd first = shape[0] * c - shape[1] * s;
  f.torsion += shape[0] * s + shape[1] * c;
  f.torsion_rate += f.load_speed * first;
  f.load_acceleration -=
      f.load_acceleration * first - f.load_speed.square() * (shape[0] * s + shape[1] * c);
}

// The same of the motor's encoder, once a turn: the motor is N e from where it was read, and the
// torsion e.
void motor_runout(Frame& f, Values shape) {
  const ArrayXd s = f.motor_angle.sin();
  const ArrayXd c = f.motor_angle.cos();
  const ArrayXd e = shape[0] * s + shape[1] * c;
  const ArrayXd first = shape[0] * c - shape[1] * s;
  f.torsion += e;
  f.torsion_rate += f.motor_speed * first;
  f.motor_angle += f.ratio * e;
  f.motor_acceleration += f.ratio * (f.motor_acceleration * first - f.motor_speed.square() * e);
  f.motor_speed += f.ratio * f.motor_speed * first;
}

// A servo has one encoder: its motor moves as the arm does.
void arm_runout(Frame& f, Values shape) {
  const ArrayXd s = f.load_angle.sin();
  const ArrayXd c = f.load_angle.cos();
  const ArrayXd e = shape[0] * s + shape[1] * c;
  const ArrayXd first = shape[0] * c - shape[1] * s;
  const ArrayXd further = f.load_acceleration * first - f.load_speed.square() * e;
  f.motor_angle -= f.ratio * e;
  f.motor_speed -= f.ratio * f.load_speed * first;
  f.motor_acceleration -= f.ratio * further;
  f.load_angle -= e;
  f.load_speed -= f.load_speed * first;
  f.load_acceleration -= further;
  f.hang_pendulum();
}

std::vector<double> small(const Frame&) { return {1e-3, 1e-3}; }

std::vector<double> motor_start(const Frame& f) {
  return periodic_torsion(f, f.motor_angle, {1.0});
}

std::vector<double> start(const Frame& f) { return periodic_torsion(f, f.load_angle, {1.0}); }

// The angle is less than measured by what is added to the torsion.
Counterpart at_the_load(const FittedCause& c) {
  return {.effects = {{"encoder_eccentricity", amplitude_and_phase(c.shape[0], c.shape[1])}}};
}

Counterpart at_the_motor(const FittedCause& c) {
  const double turns = -c.frame.ratio;
  return {.effects = {{"motor_encoder_eccentricity",
                       amplitude_and_phase(turns * c.shape[0], turns * c.shape[1])}}};
}

}  // namespace

CauseRow describe_encoder_eccentricity() {
  return {.id = "encoder_eccentricity",
          .coordinate = "motor_angle",
          .forms = {{.equation = "theta_l,measured = theta_l + e sin(theta_l + p)",
                     .rigs = {Rig::free},
                     .at = {Equation::torsion, Equation::load},
                     .shapes = amplitudes,
                     .transform = runout,
                     .start = start,
                     .counterpart = at_the_load},
                    {.equation = "theta_m,measured = theta_m + N e sin(theta_m + p)",
                     .rigs = {Rig::free},
                     .at = {Equation::torsion, Equation::motor},
                     .shapes = amplitudes,
                     .transform = motor_runout,
                     .start = motor_start,
                     .counterpart = at_the_motor},
                    {.equation = "theta_l,measured = theta_l + e sin(theta_l + p)",
                     .rigs = {Rig::servo},
                     .at = {Equation::motor},
                     .shapes = amplitudes_of_arm,
                     .transform = arm_runout,
                     .start = small,
                     .counterpart = at_the_load}}};
}

}  // namespace flexspline::studies
