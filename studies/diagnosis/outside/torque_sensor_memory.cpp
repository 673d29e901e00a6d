#include "diagnosis/model/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Values = std::span<const double>;

constexpr int kElements = 6;

std::vector<double> reaches(const Frame& f) {
  const double largest = f.largest_torque(Equation::torsion);
  return geometric(0.005 * largest, 0.5 * largest, kElements);
}

// Of the spring's torque: while the reading stands, it does not say what the torque does.
Columns held_back(Equation equation, const Frame& f, const Reference& reference, Values) {
  return of_torque_signal(equation, f, stop_operators(f, reference.elastic, reaches(f)));
}

std::vector<Term> terms(const Frame& f) {
  return elements(reaches(f), {"share", "1", "of the torque that an element holds back", "reach",
                               0.0, "Nm", "torque that it can hold; of a fixed grid"});
}

// One equation alone does not tell the sensor from what it measures.
bool told_twice(const Frame& f) {
  return f.has(Equation::torsion) && (f.has(Equation::load) || f.has(Equation::motor));
}

}  // namespace

CauseRow describe_torque_sensor_memory() {
  return {
      .id = "torque_sensor_memory",
      .coordinate = "reversal_memory",
      .forms = {{.equation = "tau_measured = tau + sum_i a_i s_i, s_i' = tau' unless |s_i| = r_i",
                 .rigs = {Rig::locked, Rig::free},
                 .at = {Equation::torsion, Equation::load, Equation::motor},
                 .terms = terms,
                 .columns = held_back,
                 .where = told_twice,
                 .no_counterpart = "torque_sensor_nonlinearity has one width"}},
      .outside = "a torque sensor whose reading stays behind at reversals"};
}

}  // namespace flexspline::studies
