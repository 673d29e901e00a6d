#include "diagnosis/model/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

// tau_m,recorded = (J1 theta_m'' + friction + tau/N)/(1 + e); friction is free to scale.
Columns gain(Equation, const Frame& f, const Reference& known, Values) {
  return {-(f.motor_inertia * f.motor_acceleration + smooth_torque(f, known) / f.ratio)};
}

// What was recorded is the share 1 - a of what there was.
Counterpart as_error(const FittedCause& c) {
  const double a = c.coefficients[0];
  return {.effects = {{"torque_constant_error", {{"error", a / (1.0 - a)}}}}};
}

std::vector<Term> terms(const Frame&) {
  return {{"error", "1", "share by which the motor torque is more than recorded"}};
}

}  // namespace

CauseRow describe_torque_constant_error() {
  return {.id = "torque_constant_error",
          .coordinate = "load",
          .forms = {{.equation = "tau_m = (1 + e) tau_m,recorded",
                     .rigs = kDrives,
                     .at = {Equation::motor},
                     .terms = terms,
                     .columns = gain,
                     .rescales = true,
                     .counterpart = as_error}}};
}

}  // namespace flexspline::studies
