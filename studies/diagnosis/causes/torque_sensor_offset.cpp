#include "diagnosis/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

Columns constant(Equation equation, const Frame& f, const Reference&, Values) {
  return of_torque_signal(equation, f, {ArrayXd::Ones(f.rows())});
}

Counterpart as_offset(const FittedCause& c) {
  return {.effects = {{"torque_sensor_offset", {{"offset", c.coefficients[0]}}}}};
}

std::vector<Term> terms(const Frame&) {
  return {{"offset", "Nm", "what the torque sensor reads without a torque"}};
}

}  // namespace

CauseRow describe_torque_sensor_offset() {
  return {.id = "torque_sensor_offset",
          .coordinate = "constant",
          .forms = {{.equation = "tau_measured = tau + o",
                     .rigs = kDrives,
                     .at = {Equation::torsion, Equation::load, Equation::motor},
                     .terms = terms,
                     .columns = constant,
                     .counterpart = as_offset}}};
}

}  // namespace flexspline::studies
