#include "diagnosis/model/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

// The square, as a sensor is set to zero where nothing pulls, and Legendre's third polynomial, of
// which a gain has no part, as it is set to the best line. Of the torque that the torsion tells: a
// polynomial of what was read would explain its noise by its noise.
Columns curved(Equation equation, const Frame& f, const Reference&, Values) {
  const double largest = f.told_torque.abs().maxCoeff();
  const ArrayXd x = f.told_torque / largest;
  return of_torque_signal(equation, f,
                          {largest * x.square(), largest * (2.5 * x.square() - 1.5) * x});
}

std::vector<Term> terms(const Frame&) {
  constexpr std::string_view kOf = "of the largest torque, in the reading";
  return {{"even", "1", std::string(kOf)}, {"odd", "1", std::string(kOf)}};
}

// The spring takes it up: a free drive's known inertia tells it, and the motor of one that is held,
// whose friction turns its sign with the motion, as the reading does not.
bool told_twice(const Frame& f) {
  return f.has(Equation::torsion) && f.has(f.rig == Rig::free ? Equation::load : Equation::motor);
}

}  // namespace

CauseRow describe_torque_sensor_curvature() {
  return {.id = "torque_sensor_curvature",
          .coordinate = "load",
          .forms = {{.equation = "tau_measured = tau + T (a x^2 + b (5 x^3 - 3 x)/2), x = tau/T",
                     .rigs = kDrives,
                     .at = {Equation::torsion, Equation::load, Equation::motor},
                     .terms = terms,
                     .columns = curved,
                     .where = told_twice,
                     .no_counterpart = "torque_sensor_nonlinearity has no even part"}},
          .outside = "a torque sensor whose reading is no line"};
}

}  // namespace flexspline::studies
