#include "diagnosis/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

// The torsion law takes the gain up in f and g^-1; known inertias do not.
Columns gain(Equation equation, const Frame& f, const Reference&, Values) {
  if (equation == Equation::load) return {f.load_inertia * f.load_acceleration};
  return {-f.torque / f.ratio};
}

}  // namespace

CauseRow describe_torque_sensor_gain() {
  return {.id = "torque_sensor_gain",
          .coordinate = "load",
          .forms = {{.equation = "tau_measured = (1 + e) tau",
                     .rigs = kDrives,
                     .at = {Equation::load, Equation::motor},
                     .columns = gain}}};
}

}  // namespace flexspline::studies
