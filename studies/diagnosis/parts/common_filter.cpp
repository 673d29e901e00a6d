#include <fmt/format.h>

#include "diagnosis/frame/low_pass.hpp"
#include "diagnosis/model/cause_columns.hpp"
#include "diagnosis/model/model.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

constexpr const char* kEquation = "T tau' + tau = tau(x + T x')";
constexpr std::string_view kOfTheBench = "a filter of the bench is no part of the gear";

std::vector<Shape> time_constant(const Frame& f) {
  return {{.name = "time_constant",
           .unit = "s",
           .lower = 0.0,
           .upper = f.longest_lag(),
           .logarithmic = false,
           .meaning = "in which both channels follow or settle"}};
}

std::vector<double> short_one(const Frame& f) { return {0.1 / f.fastest()}; }

// Of a servo all torque goes with it: by the rows, so that the filter gives it back; between rows
// that are thinned it may turn. Of a specimen, whose rows nothing weighs by what it is known to, by
// its value T later, which the filter makes smaller by sqrt(1 + w^2 T^2), and its noise with it.
ArrayXd acceleration_before(const Frame& f, double T, const ArrayXd& acceleration) {
  if (f.rig == Rig::servo) return shared_low_pass(f, T)->undone(acceleration);
  return later(f, acceleration, T);
}

// A motion before its filter, x + T x'.
void undo(const Frame& f, double T, ArrayXd& angle, ArrayXd& rate, ArrayXd& acceleration) {
  angle += T * rate;
  rate += T * acceleration;
  acceleration = acceleration_before(f, T, acceleration);
}

// The motion before its filter and the torque that it asks for, behind the same.
void before_the_filter(Frame& f, Values shape) {
  undo(f, shape[0], f.motor_angle, f.motor_speed, f.motor_acceleration);
  undo(f, shape[0], f.load_angle, f.load_speed, f.load_acceleration);
  undo(f, shape[0], f.torsion, f.torsion_rate, f.torsion_acceleration);
  if (f.rig == Rig::servo) f.hang_pendulum();
  f.torque_lag = shape[0];
}

// Of a locked drive, whose accelerations are taken off what is measured behind the same filter.
void before_the_filter_of_a_drive(Frame& f, Values shape) {
  const double T = shape[0];
  f.motor_angle += T * f.motor_speed, f.motor_speed += T * f.motor_acceleration;
  f.torsion += T * f.torsion_rate, f.torsion_rate += T * f.torsion_acceleration;
  f.torque_lag = T;
}

// The motion T later, by whatever else rounds it off as the torque is: a filter of higher order, or
// the smoothing of a motion whose acceleration jumps, at a reversal with dry friction.
void when_it_is_seen(Frame& f, Values shape) {
  for (ArrayXd* motion :
       {&f.torsion, &f.torsion_rate, &f.torsion_acceleration, &f.motor_angle, &f.motor_speed,
        &f.motor_acceleration, &f.load_angle, &f.load_speed, &f.load_acceleration}) {
    *motion = later(f, *motion, shape[0]);
  }
  f.torque_lag = shape[0];
}

std::string in_words(const Frame&, const DriveModel& model, std::size_t cause) {
  return fmt::format("angle and torque are behind one filter of {:.2g} s",
                     model.causes[cause].shape[0]);
}

}  // namespace

// What an instrument does to both channels alike is no finding: the laws hold before the filter,
// and those that are linear behind it, too. Dry friction is late behind it, and early.
CauseRow describe_common_filter() {
  return {.id = "common_filter",
          .coordinate = "lag",
          .forms = {{.equation = kEquation,
                     .rigs = {Rig::specimen},
                     .at = {Equation::torsion},
                     .shapes = time_constant,
                     .transform = before_the_filter,
                     .start = short_one,
                     .where = travels,
                     .no_counterpart = kOfTheBench},
                    {.equation = "T tau' + tau = tau(x(t + T))",
                     .rigs = {Rig::specimen},
                     .at = {Equation::torsion},
                     .shapes = time_constant,
                     .transform = when_it_is_seen,
                     .start = short_one,
                     .where = travels,
                     .no_counterpart = kOfTheBench},
                    {.equation = kEquation,
                     .rigs = {Rig::servo},
                     .at = {Equation::motor},
                     .shapes = time_constant,
                     .transform = before_the_filter,
                     .start = short_one,
                     .no_counterpart = kOfTheBench},
                    {.equation = kEquation,
                     .rigs = {Rig::locked},
                     .at = {Equation::torsion, Equation::motor},
                     .shapes = time_constant,
                     .transform = before_the_filter_of_a_drive,
                     .start = short_one,
                     .no_counterpart = kOfTheBench}},
          .part = BaselinePart{.says = in_words}};
}

}  // namespace flexspline::studies
