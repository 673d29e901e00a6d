#include <cmath>

#include <fmt/format.h>

#include "diagnosis/model/cause_columns.hpp"
#include "diagnosis/model/model.hpp"

namespace flexspline::studies {
namespace {

using Values = std::span<const double>;

double largest_load(const Frame& f) { return (f.torque.abs() * f.usable).maxCoeff(); }

std::vector<Shape> compliance(const Frame& f) {
  constexpr double kMost = 0.1;  // rad at the largest load
  return {{.name = "compliance",
           .unit = "rad/Nm",
           .lower = 0.0,
           .upper = kMost / largest_load(f),
           .logarithmic = false,
           .meaning = "of the gear between the arm and the motor, unloaded"},
          {.name = "stiffening",
           .unit = "1",
           .lower = 0.01,
           .upper = 100.0,
           .meaning = "the largest load over that at which it gets stiffer"}};
}

std::vector<double> stiff(const Frame& f) { return {1e-4 / largest_load(f), 1.0}; }

// Its speed as it was: what winds up is slow beside it.
void wound_up(Frame& f, Values shape) {
  const double load = largest_load(f) / shape[1];
  f.motor_angle += f.ratio * shape[0] * load *
                   (f.torque / load).unaryExpr([](double x) { return std::asinh(x); });
}

std::string in_words(const DriveModel& model, std::size_t cause) {
  return fmt::format("the gear winds up by {:.2g} mrad/Nm", 1e3 * model.causes[cause].shape[0]);
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
                     .shapes = compliance,
                     .transform = wound_up,
                     .start = stiff,
                     .where = geared,
                     .no_counterpart = kNoTorsion}},
          .part = BaselinePart{.says = in_words}};
}

}  // namespace flexspline::studies
