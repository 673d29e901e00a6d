#include <cmath>

#include <fmt/format.h>

#include "diagnosis/model/cause_columns.hpp"
#include "diagnosis/model/model.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

double largest_load(const Frame& f) { return (f.torque.abs() * f.usable).maxCoeff(); }

std::vector<Shape> spring(const Frame& f) {
  constexpr double kMost = 0.1;  // rad at the largest load
  const double most = largest_load(f);
  return {{.name = "compliance",
           .unit = "rad/Nm",
           .lower = 0.0,
           .upper = kMost / most,
           .logarithmic = false,
           .meaning = "of the gear between the arm and the motor, unloaded"},
          {.name = "stiffening_load",
           .unit = "Nm",
           .lower = 0.01 * most,
           .upper = 100.0 * most,
           .meaning = "from which the gear is stiffer"}};
}

std::vector<double> stiff(const Frame& f) {
  const double most = largest_load(f);
  return {1e-4 / most, most};
}

ArrayXd angle_of(const Frame& f, Values shape) {
  const ArrayXd x = f.torque / shape[1];
  return shape[0] * shape[1] * x.unaryExpr([](double v) { return std::asinh(v); });
}

// Its speed as it was: what winds up is slow beside it.
void wound_up(Frame& f, Values shape) { f.motor_angle += f.ratio * angle_of(f, shape); }

std::string in_words(const Frame& f, const DriveModel& model, std::size_t cause) {
  const ArrayXd angle = angle_of(f, model.causes[cause].shape);
  return fmt::format("the gear winds up by {:.2g} mrad at the largest load",
                     1e3 * (angle.abs() * f.usable).maxCoeff());
}

constexpr std::string_view kNoTorsion = "a servo's model file has no torsion";

}  // namespace

// A servo's encoder is at the arm: what goes by the turns of its motor goes by an angle that the
// gear winds up.
CauseRow describe_wind_up() {
  return {.id = "wind_up",
          .coordinate = "load",
          .forms = {{.equation = "theta_m = N (theta_l + c tau_s asinh(tau/tau_s))",
                     .rigs = {Rig::servo},
                     .at = {Equation::motor},
                     .shapes = spring,
                     .transform = wound_up,
                     .start = stiff,
                     .where = geared,
                     .no_counterpart = kNoTorsion}},
          .part = BaselinePart{.says = in_words}};
}

}  // namespace flexspline::studies
