#include "diagnosis/model/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Values = std::span<const double>;

constexpr double kWithin = 0.025;  // of the session: a jump that has a derivative by its time

std::vector<Shape> times(const Frame& f) {
  return {{.name = "time",
           .unit = "s",
           .lower = 0.0,
           .upper = f.session,
           .grid = 9,
           .logarithmic = false,
           .meaning = "of the session, at which it jumps"}};
}

Columns jump(Equation equation, const Frame& f, const Reference&, Values shape) {
  return of_torque_signal(equation, f,
                          {0.5 + 0.5 * ((f.clock - shape[0]) / (kWithin * f.session)).tanh()});
}

std::vector<Term> terms(const Frame&) { return {{"jump", "Nm", "of the torque sensor's zero"}}; }

bool has_a_course(const Frame& f) { return f.session > 0.0; }

}  // namespace

CauseRow describe_torque_sensor_jump() {
  return {.id = "torque_sensor_jump",
          .coordinate = "time",
          .forms = {{.equation = "tau_measured = tau, and tau + a from T of the session on",
                     .rigs = kAnyRig,
                     .at = {Equation::torsion, Equation::load, Equation::motor},
                     .shapes = times,
                     .terms = terms,
                     .columns = jump,
                     .where = has_a_course,
                     .no_counterpart = "the catalogue of effects has no sensor that jumps"}},
          .outside = "a torque sensor whose zero jumps during the session"};
}

}  // namespace flexspline::studies
