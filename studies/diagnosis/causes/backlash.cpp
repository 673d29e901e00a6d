#include <algorithm>
#include <cmath>

#include "diagnosis/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

constexpr double kRounding = 0.1;  // of the gap

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
                     .no_counterpart = kNotByMotion}}};
}

}  // namespace flexspline::studies
