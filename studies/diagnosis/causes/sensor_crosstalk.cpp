#include "diagnosis/model/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

Columns twice_a_turn(Equation equation, const Frame& f, const Reference&, Values) {
  Columns terms = sine_pair(f.motor_angle, 2.0);
  terms.push_back(ArrayXd::Ones(f.rows()));  // zeroed wherever the motor stood
  return of_torque_signal(equation, f, std::move(terms));
}

Counterpart with_its_zero(const FittedCause& c) {
  return {.effects = {{"sensor_crosstalk", harmonic(2.0, c.coefficients[0], c.coefficients[1])},
                      {"torque_sensor_offset", {{"offset", c.coefficients[2]}}}}};
}

std::vector<Term> terms(const Frame&) {
  return {{"sine", "Nm", "of the torque read twice a turn of the motor"},
          {"cosine", "Nm", "its cosine"},
          {"offset", "Nm", "its zero where the motor stood"}};
}

}  // namespace

CauseRow describe_sensor_crosstalk() {
  return {.id = "sensor_crosstalk",
          .coordinate = "motor_angle",
          .forms = {{.equation = "tau_measured = tau + a (sin(2 theta_m + p) - o)",
                     .rigs = {Rig::free},
                     .at = {Equation::torsion, Equation::load, Equation::motor},
                     .terms = terms,
                     .columns = twice_a_turn,
                     .counterpart = with_its_zero}}};
}

}  // namespace flexspline::studies
