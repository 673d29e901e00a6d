#include <fmt/format.h>

#include "diagnosis/cause_columns.hpp"
#include "diagnosis/model.hpp"

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
           .meaning = "in which both channels follow or settle"}};
}

std::vector<double> short_one(const Frame& f) { return {0.1 / f.fastest()}; }

// The motion before its filter, x + T x', and the torque that it asks for, behind the same.
void before_the_filter(Frame& f, Values shape) {
  const double T = shape[0];
  const ArrayXd later_acceleration = later(f, f.torsion_acceleration, T);
  for (ArrayXd* angle : {&f.torsion, &f.motor_angle, &f.load_angle}) {
    *angle += T * f.torsion_rate;
  }
  for (ArrayXd* rate : {&f.torsion_rate, &f.motor_speed}) *rate += T * f.torsion_acceleration;
  f.torsion_acceleration = later_acceleration;
  f.torque_lag = T;
}

std::string in_words(const DriveModel& model, std::size_t cause) {
  return fmt::format("angle and torque are behind one filter of {:.2g} s",
                     model.causes[cause].shape[0]);
}

}  // namespace

// What an instrument does to both channels alike is no finding: the laws hold before the filter,
// and those that are linear behind it, too. Dry friction is late behind it, and early.
CauseRow describe_common_filter() {
  return {.id = "common_filter",
          .coordinate = "lag",
          .forms = {{.equation = "T tau' + tau = tau(x + T x')",
                     .rigs = {Rig::specimen},
                     .at = {Equation::torsion},
                     .shapes = time_constant,
                     .transform = before_the_filter,
                     .start = short_one,
                     .where = travels,
                     .no_counterpart = "a filter of the bench is no part of the gear"}},
          .part = BaselinePart{.says = in_words}};
}

}  // namespace flexspline::studies
