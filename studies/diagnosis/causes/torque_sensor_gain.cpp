#include "diagnosis/model/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

// The torsion law takes the gain up in f and g^-1; known inertias do not. A share of the measured
// torque's noise would buy its mean with what another cause says of the same torque.
Columns gain(Equation equation, const Frame& f, const Reference& known, Values) {
  if (equation == Equation::load) return {f.load_inertia * f.load_acceleration};
  return {-smooth_torque(f, known) / f.ratio};
}

// f and g^-1 were fitted to the torque that was read, larger by the gain. The load's equation tells
// it as it is, the motor's alone by the share e/(1 + e) that was read too much.
Counterpart as_gain(const FittedCause& c) {
  const double told = c.coefficients[0];
  const double error = c.frame.has(Equation::load) ? told : told / (1.0 - told);
  return {.effects = {{"torque_sensor_gain", {{"error", error}}}},
          .law_factor = 1.0 / (1.0 + error)};
}

std::vector<Term> terms(const Frame&) {
  return {{"error", "1", "share by which the torque is read too large"}};
}

}  // namespace

CauseRow describe_torque_sensor_gain() {
  return {.id = "torque_sensor_gain",
          .coordinate = "load",
          .forms = {{.equation = "tau_measured = (1 + e) tau",
                     .rigs = kDrives,
                     .at = {Equation::load, Equation::motor},
                     .terms = terms,
                     .columns = gain,
                     .rescales = true,
                     .counterpart = as_gain}}};
}

}  // namespace flexspline::studies
