#include "diagnosis/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

Columns gain(Equation, const Frame& f, const Reference&, Values) {
  return {-f.smooth_motor_torque};
}

}  // namespace

CauseRow describe_torque_constant_error() {
  return {.id = "torque_constant_error",
          .coordinate = "load",
          .forms = {{.equation = "tau_m = (1 + e) tau_m,recorded",
                     .rigs = kDrives,
                     .at = {Equation::motor},
                     .columns = gain}}};
}

}  // namespace flexspline::studies
