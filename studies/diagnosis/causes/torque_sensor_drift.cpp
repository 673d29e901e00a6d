#include "diagnosis/model/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

std::vector<Shape> settling(const Frame& f) {
  return {{.name = "time_constant",
           .unit = "s",
           .lower = 0.05 * f.session,
           .upper = 2.0 * f.session,
           .grid = 3,
           .meaning = "in which it follows or settles"}};
}

Columns steady(Equation equation, const Frame& f, const Reference&, Values) {
  return of_torque_signal(equation, f, {f.clock / f.session});
}

Columns settles(Equation equation, const Frame& f, const Reference&, Values shape) {
  return of_torque_signal(equation, f, {1.0 - cold_share(f, shape[0])});
}

Counterpart as_rate(const FittedCause& c) {
  return {.effects = {{"torque_sensor_drift",
                       {{"rate", c.coefficients[0] / c.frame.session},
                        {"settling", 0.0},
                        {"time_constant", c.frame.session}}}},
          .caveat = kSessionClock};
}

Counterpart as_settling(const FittedCause& c) {
  return {.effects =
              {{"torque_sensor_drift",
                {{"rate", 0.0}, {"settling", c.coefficients[0]}, {"time_constant", c.shape[0]}}}},
          .caveat = kSessionClock};
}

std::vector<Term> over_session(const Frame&) {
  return {{"drift", "Nm", "what the torque sensor drifts by over the session"}};
}

std::vector<Term> in_the_end(const Frame&) {
  return {{"settling", "Nm", "what the torque sensor settles by in the end"}};
}

}  // namespace

CauseRow describe_torque_sensor_drift() {
  const std::vector<Equation> at = {Equation::torsion, Equation::load, Equation::motor};
  return {.id = "torque_sensor_drift",
          .coordinate = "time",
          .forms = {{.equation = "tau_measured = tau + r t, t of the session",
                     .rigs = kAnyRig,
                     .at = at,
                     .terms = over_session,
                     .columns = steady,
                     .counterpart = as_rate},
                    {.equation = "tau_measured = tau + a (1 - exp(-t/T)), t of the session",
                     .rigs = kAnyRig,
                     .at = at,
                     .shapes = settling,
                     .terms = in_the_end,
                     .columns = settles,
                     .counterpart = as_settling}}};
}

}  // namespace flexspline::studies
