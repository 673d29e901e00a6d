#include "diagnosis/model/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

Columns lag(Equation, const Frame& f, const Reference&, Values) { return {f.motor_torque_rate}; }

Columns lag_of_laws(Equation, const Frame&, const Reference& known, Values) {
  return {known.asked_rate};
}

Counterpart as_lag(const FittedCause& c) {
  return {.effects = {{"current_lag", {{"time_constant", c.coefficients[0]}}}}};
}

std::vector<Term> terms(const Frame&) {
  return {{"time_constant", "s", "of the filter between recorded and true motor torque"}};
}

}  // namespace

CauseRow describe_current_lag() {
  return {.id = "current_lag",
          .coordinate = "lag",
          .forms = {{.equation = "T tau_m' = tau_m,recorded - tau_m",
                     .rigs = kMotors,
                     .at = {Equation::motor},
                     .terms = terms,
                     .columns = lag,
                     .nonnegative = true,
                     .counterpart = as_lag},
                    {.equation = "tau_m,recorded = tau_m + T tau_m', tau_m as the laws ask",
                     .rigs = kMotors,
                     .at = {Equation::motor},
                     .terms = terms,
                     .columns = lag_of_laws,
                     .nonnegative = true,
                     .trails = true,
                     .counterpart = as_lag}}};
}

}  // namespace flexspline::studies
