#include <algorithm>
#include <cmath>
#include <numbers>

#include "diagnosis/model/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

constexpr double kRounding = 0.02;  // of the gap: its flanks meet, they do not yield
constexpr double kGone = 9.0;       // widths, where x exp(-x^2/2) is 2e-17

std::vector<Shape> gap(const Frame& f) {
  return {{.name = "half_gap",
           .unit = "rad",
           .lower = 0.01 * f.torsion_range,
           .upper = 0.7 * f.torsion_range,
           .grid = 8,
           .meaning = "half of the gap"}};
}

ArrayXd wound(const ArrayXd& phi, double b) {
  const double w2 = kRounding * kRounding * b * b;
  return phi - 0.5 * (((phi + b).square() + w2).sqrt() - ((phi - b).square() + w2).sqrt());
}

ArrayXd wound_slope(const ArrayXd& phi, double b) {
  const double w2 = kRounding * kRounding * b * b;
  return 1.0 - 0.5 * ((phi + b) / ((phi + b).square() + w2).sqrt() -
                      (phi - b) / ((phi - b).square() + w2).sqrt());
}

void spring_alone(Frame& f, Values shape) { f.torsion = wound(f.torsion, shape[0]); }

void whole_gear(Frame& f, Values shape) {
  f.torsion_rate *= wound_slope(f.torsion, shape[0]);
  f.torsion = wound(f.torsion, shape[0]);
}

std::vector<Shape> lost_motion(const Frame& f) {
  return {{.name = "half_gap",
           .unit = "rad",
           .lower = 0.005 * f.torsion_range,
           .upper = 0.7 * f.torsion_range,
           .grid = 6,
           .meaning = "half of the gap"},
          {.name = "width",
           .unit = "Nm",
           .lower = 0.003 * f.torque_range,
           .upper = 0.3 * f.torque_range,
           .meaning = "over which it turns its sign, or around zero torque"}};
}

// The gap is crossed as the torque changes sign: e = b tau/sqrt(tau^2 + t^2).
void around_zero_torque(Frame& f, Values shape) {
  const ArrayXd root = (f.smooth_torque.square() + shape[1] * shape[1]).sqrt();
  f.torsion -= shape[0] * f.smooth_torque / root;
  f.torsion_rate -= shape[0] * shape[1] * shape[1] * f.torque_rate / root.cube();
}

// The gap opens again at every reversal: what is driven stands still until it is crossed.
void after_reversal(Frame& f, Values shape) {
  for (const Segment& s : f.segments) {
    double driven = f.torsion[s.first];
    for (Eigen::Index r = s.first; r < s.first + s.count; ++r) {
      const double lead = (f.torsion[r] - driven) / shape[0];
      const double engaged = std::clamp((std::abs(lead) - 1.0) / kRounding + 1.0, 0.0, 1.0);
      const bool pushes = lead * f.torsion_rate[r] > 0.0;
      if (std::abs(lead) > 1.0) driven = f.torsion[r] - std::copysign(shape[0], lead);
      f.torsion_rate[r] *= pushes ? engaged : 0.0;
      f.torsion[r] = driven;
    }
  }
}

bool moves_its_motor(const Frame& f) { return geared(f) && f.motor_inertia > 0.0; }

std::vector<Shape> crossing(const Frame& f) {
  return {{.name = "crossing_time",
           .unit = "s",
           .lower = 0.3 * f.interval,
           .upper = 3.0 * f.interval,
           .meaning = "standard deviation in time of the motor's rate across the gap"}};
}

// As the load's torque changes its sign the motor jumps by a = 2 N b, in this rig unseen, by the
// normal distribution's law in time: its torque shows J1 times the acceleration of that.
Columns motor_jumps(Equation, const Frame& f, const Reference&, Values shape) {
  const double width = shape[0];
  const double unit = f.motor_inertia / (width * width) * std::numbers::inv_sqrtpi / std::sqrt(2.0);
  ArrayXd column = ArrayXd::Zero(f.rows());
  for (const Segment& s : f.segments) {
    const double* const start = f.time.data() + s.first;
    const double* const end = start + s.count;
    for (Eigen::Index r = s.first; r + 1 < s.first + s.count; ++r) {
      const double before = f.torque[r], after = f.torque[r + 1];
      if (before * after >= 0.0) continue;
      const double at = f.time[r] + before / (before - after) * (f.time[r + 1] - f.time[r]);
      const double* const first = std::lower_bound(start, end, at - kGone * width);
      const double* const last = std::upper_bound(first, end, at + kGone * width);
      const auto near = Eigen::seqN(first - f.time.data(), last - first);
      const ArrayXd x = (f.time(near) - at) / width;
      column(near) -= std::copysign(unit, after) * x * (-0.5 * x.square()).exp();
    }
  }
  return {column};
}

std::vector<Term> jump(const Frame&) {
  return {{"jump", "rad", "of the motor, 2 N b if its torque alone moves it"}};
}

// f gets what is beyond the gap; the damper moves in it too.
Counterpart gap_of_the_spring(const FittedCause& c) {
  const double b = c.shape[0];
  return {.spring_sees = [b](double phi) { return wound(ArrayXd::Constant(1, phi), b)[0]; },
          .caveat = "f itself stays flat in the gap; what else goes by the torsion sees all of it"};
}

Counterpart gap_of_the_gear(const FittedCause& c) {
  return {
      .effects = {{"backlash", {{"half_gap", c.shape[0]}, {"rounding", kRounding * c.shape[0]}}}}};
}

Counterpart as_lost_motion(const FittedCause& c) {
  return {.effects = {{"lost_motion", {{"half_gap", c.shape[0]}, {"width", c.shape[1]}}}}};
}

constexpr std::string_view kNotByMotion =
    "the catalogue's play follows the torque, not the torsion";
constexpr std::string_view kByItsLoop =
    "what crosses the gap is the motor's loop; how wide the gap is its torque does not tell";

}  // namespace

CauseRow describe_backlash() {
  const std::vector<Equation> at = {Equation::torsion};
  return {.id = "backlash",
          .coordinate = "torsion",
          .forms = {{.equation = "f(phi_e), phi_e = phi - clamp(phi, -b, b)",
                     .rigs = kAnyRig,
                     .at = at,
                     .shapes = gap,
                     .transform = spring_alone,
                     .where = wound_up,
                     .counterpart = gap_of_the_spring},
                    {.equation = "f(phi_e) + g^-1(phi_e'/h), phi_e = phi - clamp(phi, -b, b)",
                     .rigs = kAnyRig,
                     .at = at,
                     .shapes = gap,
                     .transform = whole_gear,
                     .where = wound_up,
                     .counterpart = gap_of_the_gear},
                    {.equation = "f(phi_e) + g^-1(phi_e'/h), phi_e = phi - b tau/sqrt(tau^2 + t^2)",
                     .rigs = kAnyRig,
                     .at = at,
                     .shapes = lost_motion,
                     .transform = around_zero_torque,
                     .where = wound_up,
                     .counterpart = as_lost_motion},
                    {.equation = "f(p) + g^-1(p'/h), p the play of phi by b on either side",
                     .rigs = {Rig::specimen},
                     .at = at,
                     .shapes = gap,
                     .transform = after_reversal,
                     .where = wound_up,
                     .no_counterpart = kNotByMotion},
                    {.equation = "tau_f += J1 a e'', e a step of the motor as the load's torque "
                                 "changes its sign",
                     .rigs = {Rig::servo},
                     .at = {Equation::motor},
                     .shapes = crossing,
                     .terms = jump,
                     .columns = motor_jumps,
                     .nonnegative = true,
                     .where = moves_its_motor,
                     .no_counterpart = kByItsLoop}}};
}

}  // namespace flexspline::studies
