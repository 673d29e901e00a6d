#include "diagnosis/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

Columns lag(Equation, const Frame& f, const Reference&, Values) { return {f.motor_torque_rate}; }

}  // namespace

CauseRow describe_current_lag() {
  return {.id = "current_lag",
          .coordinate = "lag",
          .forms = {{.equation = "T tau_m' = tau_m,recorded - tau_m",
                     .rigs = kDrives,
                     .at = {Equation::motor},
                     .columns = lag,
                     .nonnegative = true}}};
}

}  // namespace flexspline::studies
