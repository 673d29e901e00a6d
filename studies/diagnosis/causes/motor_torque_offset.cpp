#include "diagnosis/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

Columns constant(Equation, const Frame& f, const Reference&, Values) {
  return {ArrayXd::Ones(f.rows())};
}

Counterpart as_offset(const FittedCause& c) {
  return {.effects = {{"motor_torque_offset", {{"offset", c.coefficients[0]}}}}};
}

std::vector<Term> terms(const Frame&) {
  return {{"offset", "Nm", "what is recorded of a motor without a torque"}};
}

}  // namespace

CauseRow describe_motor_torque_offset() {
  return {.id = "motor_torque_offset",
          .coordinate = "constant",
          .forms = {{.equation = "tau_m,recorded = tau_m + o",
                     .rigs = kMotors,
                     .at = {Equation::motor},
                     .terms = terms,
                     .columns = constant,
                     .counterpart = as_offset}}};
}

}  // namespace flexspline::studies
