#include "diagnosis/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

Columns constant(Equation, const Frame& f, const Reference&, Values) {
  return {ArrayXd::Ones(f.rows())};
}

}  // namespace

CauseRow describe_motor_torque_offset() {
  return {.id = "motor_torque_offset",
          .coordinate = "constant",
          .forms = {{.equation = "tau_m,recorded = tau_m + o",
                     .rigs = kDrives,
                     .at = {Equation::motor},
                     .columns = constant}}};
}

}  // namespace flexspline::studies
