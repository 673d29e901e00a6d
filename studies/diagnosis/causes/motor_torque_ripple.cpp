#include <cmath>
#include <numbers>

#include "diagnosis/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

constexpr double kHighestOrder = 36.0;
constexpr double kLeastSeen = 0.25;  // of all rows: docs/decisions/0032
// Of the largest speed. Beyond 3 the loop answers with 0.95 of all and more, as the plain form;
// below 0.03 with a thirtieth at most where the motor is fastest.
constexpr double kSlowestCorner = 0.03, kFastestCorner = 3.0;
constexpr std::string_view kOfTheLoop =
    "a control loop is no part of the gear; at rest the ripple is what the parameters say";

std::vector<Shape> turns_up_to(double highest) {
  return {{.name = "order",
           .unit = "1",
           .lower = 1.0,
           .upper = highest,
           .discrete = true,
           .meaning = "of a turn of the motor"}};
}

std::vector<Shape> turns(const Frame&) { return turns_up_to(kHighestOrder); }

std::vector<Shape> turns_and_zero(const Frame& f) {
  auto shapes = turns(f);
  shapes.push_back({.name = "zeroed_at",
                    .unit = "rad",
                    .lower = -std::numbers::pi,
                    .upper = std::numbers::pi,
                    .logarithmic = false,
                    .meaning = "phase of the ripple at which the channel was zeroed"});
  return shapes;
}

bool ripples(double order) { return order >= 1.0 && order <= kHighestOrder; }

Columns ripple(Equation, const Frame& f, const Reference&, Values shape) {
  return sine_pair(f.motor_angle, shape[0]);
}

Columns ripple_under_current(Equation, const Frame& f, const Reference&, Values shape) {
  return sine_pair(f.motor_angle, shape[0], f.smooth_motor_torque);
}

// A motor whose drive does not answer a ripple follows it, and J theta'' takes it up. With theta''
// smoothed, J theta''_s = H (tau_m - tau_f - ripple): of the smooth torques all is left, of the
// ripple what the smoothing H keeps.
ArrayXd kept(const Frame& f, double order) {
  if (f.motor_bandwidth.size() == 0) return ArrayXd::Ones(f.rows());
  return 1.0 / (1.0 + (order * f.motor_speed / f.motor_bandwidth).pow(6.0));
}

Columns ripple_followed(Equation, const Frame& f, const Reference&, Values shape) {
  return sine_pair(f.motor_angle, shape[0], kept(f, shape[0]));
}

Columns ripple_under_current_followed(Equation, const Frame& f, const Reference&, Values shape) {
  return sine_pair(f.motor_angle, shape[0], kept(f, shape[0]) * f.smooth_motor_torque);
}

// Whether a quarter of all rows lies in stretches in which smoothing keeps a whole period of a
// ripple and more. What is kept about reversals alone is no ripple, but what friction does there.
bool shows_periods(const Frame& f, double order) {
  const auto seen = [&](Eigen::Index r) {  // kept by half and more
    return f.motor_bandwidth.size() == 0 ||
           order * std::abs(f.motor_speed[r]) < f.motor_bandwidth[r];
  };
  Eigen::Index in_periods = 0;
  for (const Segment& s : f.segments) {
    Eigen::Index first = s.first;
    for (Eigen::Index r = s.first; r <= s.first + s.count; ++r) {
      if (r < s.first + s.count && seen(r)) continue;
      const auto stretch = f.motor_angle.segment(first, r - first);
      const double turned = r > first ? stretch.maxCoeff() - stretch.minCoeff() : 0.0;
      if (order * turned > 2.0 * std::numbers::pi) in_periods += r - first;
      first = r + 1;
    }
  }
  return static_cast<double>(in_periods) > kLeastSeen * static_cast<double>(f.rows());
}

std::vector<Shape> turns_that_show(const Frame& f) {
  double highest = kHighestOrder;
  while (highest > 1.0 && !shows_periods(f, highest)) --highest;
  return turns_up_to(highest);
}

// Where smoothing takes away a tenth and more of an order that shows.
bool follows(const Frame& f) {
  if (!geared(f)) return false;
  const double highest = turns_that_show(f).front().upper;
  return shows_periods(f, highest) && kept(f, highest).minCoeff() < 0.9;
}

std::vector<Shape> turns_and_corner(const Frame& f) {
  auto shapes = turns(f);
  shapes.push_back({.name = "corner_speed",
                    .unit = "rad/s",
                    .lower = kSlowestCorner * f.speed_range,
                    .upper = kFastestCorner * f.speed_range,
                    .meaning = "of the motor, above which its control loop does not keep up"});
  return shapes;
}

// A loop that holds a motor to its reference answers what disturbs it, Re[c e^(i k theta)], by
// Re[T c e^(i k theta)]: all of it at rest, and as a filter of first order what comes faster,
// T = 1/(1 + i theta'/w).
Columns ripple_answered(Equation, const Frame& f, const Reference&, Values shape) {
  const ArrayXd speed = f.motor_speed / shape[1];
  const ArrayXd share = 1.0 / (1.0 + speed.square());
  const Columns wave = sine_pair(f.motor_angle, shape[0], share);
  return {wave[0] - speed * wave[1], wave[1] + speed * wave[0]};
}

// A channel that ripples was zeroed at some angle of the motor: there it shows nothing.
Columns ripple_of_channel(Equation, const Frame& f, const Reference&, Values shape) {
  Columns columns = sine_pair(f.motor_angle, shape[0]);
  columns[0] -= std::sin(shape[1]);
  columns[1] -= std::cos(shape[1]);
  return columns;
}

Counterpart cogging(const FittedCause& c) {
  return {.effects = {{"motor_torque_ripple",
                       {{"order", c.shape[0]},
                        {"cogging_sine", c.coefficients[0]},
                        {"cogging_cosine", c.coefficients[1]},
                        {"ripple_sine", 0.0},
                        {"ripple_cosine", 0.0}}}}};
}

Counterpart with_its_zero(const FittedCause& c) {
  Counterpart counterpart = cogging(c);
  const double zero =
      c.coefficients[0] * std::sin(c.shape[1]) + c.coefficients[1] * std::cos(c.shape[1]);
  counterpart.effects.push_back({"motor_torque_offset", {{"offset", -zero}}});
  return counterpart;
}

Counterpart under_current(const FittedCause& c) {
  return {.effects = {{"motor_torque_ripple",
                       {{"order", c.shape[0]},
                        {"cogging_sine", 0.0},
                        {"cogging_cosine", 0.0},
                        {"ripple_sine", c.coefficients[0]},
                        {"ripple_cosine", c.coefficients[1]}}}}};
}

std::vector<Term> cogging_terms(const Frame&) {
  return {{"sine", "Nm", "of the ripple over the motor angle"}, {"cosine", "Nm", "its cosine"}};
}

std::vector<Term> ripple_terms(const Frame&) {
  return {{"sine", "1", "of the ripple, a share of the motor torque"},
          {"cosine", "1", "its cosine"}};
}

}  // namespace

CauseRow describe_motor_torque_ripple() {
  return {.id = "motor_torque_ripple",
          .coordinate = "motor_angle",
          .forms = {{.equation = "tau_f += a sin k theta_m + b cos k theta_m",
                     .rigs = kTurning,
                     .at = {Equation::motor},
                     .shapes = turns,
                     .terms = cogging_terms,
                     .columns = ripple,
                     .where = geared,
                     .ripples = ripples,
                     .counterpart = cogging},
                    {.equation = "tau_m,recorded = tau_m + a (sin k theta_m - sin p) + b (cos k "
                                 "theta_m - cos p)",
                     .rigs = kTurning,
                     .at = {Equation::motor},
                     .shapes = turns_and_zero,
                     .terms = cogging_terms,
                     .columns = ripple_of_channel,
                     .extends = true,
                     .where = geared,
                     .counterpart = with_its_zero},
                    {.equation = "tau_f += tau_m (a sin k theta_m + b cos k theta_m)",
                     .rigs = kTurning,
                     .at = {Equation::motor},
                     .shapes = turns,
                     .terms = ripple_terms,
                     .columns = ripple_under_current,
                     .where = geared,
                     .counterpart = under_current},
                    {.equation = "tau_f += a sin k theta_m + b cos k theta_m, which the motor "
                                 "follows",
                     .rigs = kTurning,
                     .at = {Equation::motor},
                     .shapes = turns_that_show,
                     .terms = cogging_terms,
                     .columns = ripple_followed,
                     .where = follows,
                     .counterpart = cogging},
                    {.equation = "tau_f += tau_m (a sin k theta_m + b cos k theta_m), which the "
                                 "motor follows",
                     .rigs = kTurning,
                     .at = {Equation::motor},
                     .shapes = turns_that_show,
                     .terms = ripple_terms,
                     .columns = ripple_under_current_followed,
                     .where = follows,
                     .counterpart = under_current},
                    {.equation = "tau_f += a sin k theta_m + b cos k theta_m, of which the loop "
                                 "answers 1/(1 + i theta_m'/w)",
                     .rigs = {Rig::servo},
                     .at = {Equation::motor},
                     .shapes = turns_and_corner,
                     .terms = cogging_terms,
                     .columns = ripple_answered,
                     .where = geared,
                     .no_counterpart = kOfTheLoop}}};
}

}  // namespace flexspline::studies
