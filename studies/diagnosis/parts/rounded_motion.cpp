#include <fmt/format.h>

#include "diagnosis/model/cause_columns.hpp"
#include "diagnosis/model/model.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

std::vector<Shape> time_constant(const Frame& f) {
  return {{.name = "time_constant",
           .unit = "s",
           .lower = 0.0,
           .upper = f.longest_lag(),
           .logarithmic = false,
           .meaning = "over which both channels are rounded off"}};
}

std::vector<double> short_one(const Frame& f) { return {0.1 / f.fastest()}; }

void when_it_is_seen(Frame& f, Values shape) {
  for (ArrayXd* motion :
       {&f.torsion, &f.torsion_rate, &f.torsion_acceleration, &f.motor_angle, &f.motor_speed,
        &f.motor_acceleration, &f.load_angle, &f.load_speed, &f.load_acceleration}) {
    *motion = later(f, *motion, shape[0]);
  }
  f.torque_lag += shape[0];
}

std::string in_words(const Frame&, const DriveModel& model, std::size_t cause) {
  return fmt::format("angle and torque are rounded off alike, over {:.2g} s",
                     model.causes[cause].shape[0]);
}

}  // namespace

// A filter of higher order on both channels, or the smoothing of a motion whose acceleration jumps,
// as it does at a reversal with dry friction: the torque is behind a filter, and none of it is
// late.
CauseRow describe_rounded_motion() {
  return {.id = "rounded_motion",
          .coordinate = "lag",
          .forms = {{.equation = "T tau' + tau = tau(x(t + T))",
                     .rigs = {Rig::specimen},
                     .at = {Equation::torsion},
                     .shapes = time_constant,
                     .transform = when_it_is_seen,
                     .start = short_one,
                     .where = travels,
                     .no_counterpart = "a filter of the bench is no part of the gear"}},
          .part = BaselinePart{.says = in_words}};
}

}  // namespace flexspline::studies
