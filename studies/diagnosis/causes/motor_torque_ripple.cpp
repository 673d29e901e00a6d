#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "diagnosis/model/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXcd;
using Eigen::ArrayXd;
using Values = std::span<const double>;

// As many as slots and poles have in common, as 36 and 40 of a joint's motor (360); where the load
// tells the motor's angle, or the torsion of a specimen, no more than these are known to.
constexpr double kHighestOrder = 400.0, kHighestTold = 36.0;
constexpr double kMostRows = 0.5;
constexpr double kPeriods = 2.0;  // of the widest motion of a held output: slower ones are f
// Of the largest speed. Beyond 3 the loop answers with 0.95 of all and more, as the plain form;
// below 0.03 with a thirtieth at most where the motor is fastest.
constexpr double kSlowestCorner = 0.03, kFastestCorner = 3.0;
// Of a loop: below it rings on, above it is of first order.
constexpr double kLeastDamping = 0.3, kMostDamping = 3.0;
// Of the motor under the largest torque, rad: less turns no phase that could be told, and a gear is
// not wound up by more.
constexpr double kLeastWindup = 0.01, kMostWindup = 1.0;
constexpr std::string_view kOfTheTorque =
    "a specimen has no motor: the torque was told by one, whose ripple is no part of the gear";
constexpr std::string_view kOfTheLoop =
    "a control loop is no part of the gear; at rest the ripple is what the parameters say";

double highest_order(const Frame& f) {
  return f.rig == Rig::locked || f.rig == Rig::free ? kHighestOrder : kHighestTold;
}

std::vector<Shape> turns(const Frame& f) {
  return {{.name = "order",
           .unit = "1",
           .lower = 1.0,
           .upper = highest_order(f),
           .discrete = true,
           .meaning = "of a turn of the motor"}};
}

// Of a gear whose output is held: the torsion as recorded, times the ratio.
ArrayXd motor_angle_of_specimen(const Frame& f) {
  ArrayXd torsion = f.torsion + f.zero;
  for (const Segment& s : f.segments) torsion.segment(s.first, s.count) += s.zero;
  return f.ratio * torsion;
}

// That of which the widest recording has kPeriods.
double lowest_order_beside_f(const Frame& f) {
  double widest = 0.0;
  for (const Segment& s : f.segments) {
    const auto torsion = f.torsion.segment(s.first, s.count);
    widest = std::max(widest, f.ratio * (torsion.maxCoeff() - torsion.minCoeff()));
  }
  return std::ceil(kPeriods * 2.0 * std::numbers::pi / widest);
}

std::vector<Shape> turns_beside_f(const Frame& f) {
  auto shapes = turns(f);
  shapes.front().lower = lowest_order_beside_f(f);
  return shapes;
}

bool ripples_beside_f(const Frame& f) {
  return geared(f) && !f.travels && lowest_order_beside_f(f) <= highest_order(f);
}

Columns ripple_of_specimen(Equation, const Frame& f, const Reference&, Values shape) {
  return sine_pair(motor_angle_of_specimen(f), shape[0]);
}

bool winds_up(const Frame& f) { return geared(f) && f.torque_range > 0.0; }

bool ripples(double order) { return order >= 1.0 && order <= kHighestTold; }

Columns ripple(Equation, const Frame& f, const Reference&, Values shape) {
  return sine_pair(f.motor_angle, shape[0]);
}

Columns ripple_under_current(Equation, const Frame& f, const Reference&, Values shape) {
  return sine_pair(f.motor_angle, shape[0], f.smooth_motor_torque);
}

// H, what smoothing keeps of an acceleration at s = i k theta': docs/decisions/0032.
ArrayXd kept(const Frame& f, double order) {
  if (f.motor_bandwidth.size() == 0) return ArrayXd::Ones(f.rows());
  return 1.0 / (1.0 + (order * f.motor_speed / f.motor_bandwidth).cube().square());
}

std::vector<Shape> and_loop(std::vector<Shape> shapes, const Frame& f) {
  shapes.push_back({.name = "corner_speed",
                    .unit = "rad/s",
                    .lower = kSlowestCorner * f.speed_range,
                    .upper = kFastestCorner * f.speed_range,
                    .meaning = "of the motor, above which its control loop does not keep up"});
  shapes.push_back({.name = "loop_damping",
                    .unit = "1",
                    .lower = kLeastDamping,
                    .upper = kMostDamping,
                    .meaning = "damping ratio of that loop"});
  return shapes;
}

std::vector<Shape> turns_and_loop(const Frame& f) { return and_loop(turns(f), f); }

std::vector<Shape> turns_loop_and_windup(const Frame& f) {
  auto shapes = and_loop(turns(f), f);
  shapes.push_back({.name = "windup",
                    .unit = "rad",
                    .lower = kLeastWindup,
                    .upper = kMostWindup,
                    .meaning = "of the motor ahead of the load under the largest torque"});
  return shapes;
}

/// What is left of a ripple in the motor equation, behind a loop and before an elastic gear:
/// docs/decisions/0041. The loop C = G s + K, the motor J1, the load J2 at its shaft, J both, on a
/// gear whose compliance c is one of the output; H what smoothing keeps of an acceleration. With
/// q = 1 + c N^2 J2 s^2 at s = i k theta',
///   T = (C q + M s^2) / (C q + (J1 q + J2) s^2),
/// M = H J on a servo, of whose load alone the acceleration is known, and H J1 q + J2 where the
/// motor's is and the torque of the gear is recorded. Here over J w^2, x = theta'/w, w = G/(J k),
/// and K J/G^2 = 1/(4 z^2).
struct Loop {
  double order;             ///< k, of a turn of the motor
  double corner;            ///< w, rad/s of the motor
  double damping;           ///< z
  double load = 0.0;        ///< J2, kg m^2
  double compliance = 0.0;  ///< c, rad/Nm

  /// T of every row; 1 at rest.
  ArrayXcd share(const Frame& f) const {
    const double turns = f.ratio * f.ratio;
    const double motor = f.motor_inertia > 0.0 ? f.motor_inertia / (f.motor_inertia + load) : 1.0;
    const ArrayXd x = f.motor_speed / corner;
    const ArrayXd q = 1.0 - compliance * turns * load * (order * f.motor_speed).square();
    const ArrayXd inertia = motor * q + (1.0 - motor);
    const ArrayXd h = kept(f, order);
    const ArrayXd seen = f.rig == Rig::servo ? h : h * motor * q + (1.0 - motor);
    const ArrayXcd i_x = std::complex<double>(0.0, 1.0) * x.cast<std::complex<double>>();
    const ArrayXcd answer = (i_x + 0.25 / (damping * damping)) * q;
    return (answer - seen * x.square()) / (answer - inertia * x.square());
  }
};

// Whether most rows lie in stretches in which half and more is left of whole periods. What is left
// about reversals alone is no ripple, but what friction does there.
bool shows_periods(const Frame& f, const ArrayXd& left, double order) {
  Eigen::Index in_periods = 0;
  for (const Segment& s : f.segments) {
    Eigen::Index first = s.first;
    for (Eigen::Index r = s.first; r <= s.first + s.count; ++r) {
      if (r < s.first + s.count && left[r] > 0.5) continue;
      const auto stretch = f.motor_angle.segment(first, r - first);
      const double turned = r > first ? stretch.maxCoeff() - stretch.minCoeff() : 0.0;
      if (order * turned > 2.0 * std::numbers::pi) in_periods += r - first;
      first = r + 1;
    }
  }
  return static_cast<double>(in_periods) > kMostRows * static_cast<double>(f.rows());
}

// Re[T c e^(i k theta)], the c by the factor of a row; nothing where no ripple would be seen.
Columns left_of(const Loop& loop, const Frame& f, const ArrayXd& angle, const ArrayXd& factor) {
  const ArrayXcd share = loop.share(f);
  if (!shows_periods(f, share.abs(), loop.order)) return Columns(2, ArrayXd::Zero(f.rows()));
  const Columns wave = sine_pair(angle, loop.order, factor);
  return {share.real() * wave[0] + share.imag() * wave[1],
          share.real() * wave[1] - share.imag() * wave[0]};
}

// The motor turns ahead of the load by the gear's windup, in proportion to the torque. Where the
// inertias are not stated the gear is a stiff one.
Columns ripple_of_servo(Equation, const Frame& f, const Reference&, Values shape) {
  const double windup = shape[3] / f.torque_range;
  Loop loop{shape[0], shape[1], shape[2]};
  if (f.motor_inertia > 0.0 && f.load_mass > 0.0 && f.arm_length > 0.0) {
    loop.load = f.load_mass * f.arm_length * f.arm_length / (f.ratio * f.ratio);
    loop.compliance = windup / f.ratio;
  }
  return left_of(loop, f, f.motor_angle + windup * f.torque, ArrayXd::Ones(f.rows()));
}

Loop loop_of_drive(const Frame& f, Values shape) {
  return {shape[0], shape[1], shape[2], f.load_inertia / (f.ratio * f.ratio),
          f.torsion_range / f.torque_range};
}

Columns ripple_of_drive(Equation, const Frame& f, const Reference&, Values shape) {
  return left_of(loop_of_drive(f, shape), f, f.motor_angle, ArrayXd::Ones(f.rows()));
}

Columns ripple_of_drive_under_current(Equation, const Frame& f, const Reference&, Values shape) {
  return left_of(loop_of_drive(f, shape), f, f.motor_angle, f.smooth_motor_torque);
}

Counterpart cogging(const FittedCause& c) {
  return {.effects = {{"motor_torque_ripple",
                       {{"order", c.shape[0]},
                        {"cogging_sine", c.coefficients[0]},
                        {"cogging_cosine", c.coefficients[1]},
                        {"ripple_sine", 0.0},
                        {"ripple_cosine", 0.0}}}}};
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
                    {.equation = "tau_f += a sin k theta_m + b cos k theta_m",
                     .rigs = {Rig::locked},
                     .at = {Equation::motor},
                     .shapes = turns_beside_f,
                     .terms = cogging_terms,
                     .columns = ripple,
                     .where = ripples_beside_f,
                     .counterpart = cogging},
                    {.equation = "tau_f += tau_m (a sin k theta_m + b cos k theta_m)",
                     .rigs = kTurning,
                     .at = {Equation::motor},
                     .shapes = turns,
                     .terms = ripple_terms,
                     .columns = ripple_under_current,
                     .where = geared,
                     .counterpart = under_current},
                    {.equation = "tau += a sin k N phi + b cos k N phi, phi as recorded",
                     .rigs = {Rig::specimen},
                     .at = {Equation::torsion},
                     .shapes = turns_beside_f,
                     .terms = cogging_terms,
                     .columns = ripple_of_specimen,
                     .where = ripples_beside_f,
                     .ripples = ripples,
                     .no_counterpart = kOfTheTorque},
                    {.equation = "tau_f += T(a sin k theta_m + b cos k theta_m), what a loop, the "
                                 "motor and the gear leave of it",
                     .rigs = {Rig::free},
                     .at = {Equation::motor},
                     .shapes = turns_and_loop,
                     .terms = cogging_terms,
                     .columns = ripple_of_drive,
                     .where = winds_up,
                     .counterpart = cogging},
                    {.equation = "tau_f += T(tau_m (a sin k theta_m + b cos k theta_m)), what a "
                                 "loop, the motor and the gear leave of it",
                     .rigs = {Rig::free},
                     .at = {Equation::motor},
                     .shapes = turns_and_loop,
                     .terms = ripple_terms,
                     .columns = ripple_of_drive_under_current,
                     .where = winds_up,
                     .counterpart = under_current},
                    {.equation = "tau_f += T(a sin k theta_m + b cos k theta_m), what a loop, the "
                                 "motor and the gear leave of it",
                     .rigs = {Rig::servo},
                     .at = {Equation::motor},
                     .shapes = turns_loop_and_windup,
                     .terms = cogging_terms,
                     .columns = ripple_of_servo,
                     .where = winds_up,
                     .no_counterpart = kOfTheLoop}}};
}

}  // namespace flexspline::studies
