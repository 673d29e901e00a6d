#include "diagnosis/model/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

// Legendre's second and third polynomials of the torque over its largest value: what a gain and an
// offset have no part of.
Columns curved(Equation equation, const Frame& f, const Reference&, Values) {
  const double largest = f.smooth_torque.abs().maxCoeff();
  const ArrayXd x = f.smooth_torque / largest;
  return of_torque_signal(
      equation, f, {largest * (1.5 * x.square() - 0.5), largest * (2.5 * x.square() - 1.5) * x});
}

std::vector<Term> terms(const Frame&) {
  constexpr std::string_view kOf = "of the largest torque, in the reading";
  return {{"even", "1", std::string(kOf)}, {"odd", "1", std::string(kOf)}};
}

// The spring takes it up: known inertias tell it, not a motor's friction that goes by the load.
bool told_by_inertia(const Frame& f) { return f.has(Equation::torsion) && f.has(Equation::load); }

}  // namespace

CauseRow describe_torque_sensor_curvature() {
  return {.id = "torque_sensor_curvature",
          .coordinate = "load",
          .forms = {{.equation = "tau_measured = tau + T (a P2(tau/T) + b P3(tau/T))",
                     .rigs = {Rig::free},
                     .at = {Equation::torsion, Equation::load, Equation::motor},
                     .terms = terms,
                     .columns = curved,
                     .where = told_by_inertia,
                     .no_counterpart = "the catalogue of effects has no curve of a sensor"}},
          .outside = "a torque sensor whose reading is no line"};
}

}  // namespace flexspline::studies
