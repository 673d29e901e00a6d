#include "diagnosis/frame/mode.hpp"
#include "diagnosis/model/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Values = std::span<const double>;

constexpr int kFrequencies = 12;
constexpr double kLeastDamping = 0.01;

std::vector<Shape> frequency_and_damping(const Frame& f) {
  return {{.name = "frequency",
           .unit = "Hz",
           .lower = slowest_mode(f) / kTurn,
           .upper = fastest_mode(f) / kTurn,
           .grid = kFrequencies,
           .meaning = "of the mode"},
          {.name = "damping",
           .unit = "1",
           .lower = kLeastDamping,
           .upper = kMostDamping,
           .meaning = "its ratio"}};
}

// Of the torque that the laws ask for, whose noise is in both reading and residual.
Columns ringing(Equation equation, const Frame& f, const Reference& known, Values shape) {
  ModeAnswer answer = answer_of(f, known.elastic + known.friction, {kTurn * shape[0], shape[1]});
  return of_torque_signal(equation, f, {std::move(answer.place), std::move(answer.speed)});
}

std::vector<Term> terms(const Frame&) {
  return {{"place", "1", "of what the mode goes beyond the torque"},
          {"speed", "1", "of its speed over its frequency"}};
}

bool rows_tell(const Frame& f) {
  return wound_up(f) && f.has(Equation::torsion) && fastest_mode(f) > slowest_mode(f);
}

}  // namespace

// A sensor that rings, or what it is fixed to: beside a delay and an inertia, which a mode far
// above the motion is.
CauseRow describe_torque_resonance() {
  return {.id = "torque_resonance",
          .coordinate = "lag",
          .forms = {{.equation = "tau_measured = tau + a (q - tau) + b q'/w, q'' + 2 z w q' + w^2 "
                                 "q = w^2 tau",
                     .rigs = kAnyRig,
                     .at = {Equation::torsion, Equation::load, Equation::motor},
                     .shapes = frequency_and_damping,
                     .terms = terms,
                     .columns = ringing,
                     .where = rows_tell,
                     .no_counterpart = "the catalogue of effects has no mode of the sensor"}},
          .outside = "a torque sensor, or what it is fixed to, that rings"};
}

}  // namespace flexspline::studies
