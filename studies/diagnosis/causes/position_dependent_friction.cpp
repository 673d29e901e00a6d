#include "diagnosis/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

// Once and twice a turn of the wave generator.
Columns turns(const ArrayXd& angle, const ArrayXd& sign) {
  Columns columns = sine_pair(angle, 1.0, sign);
  for (ArrayXd& column : sine_pair(angle, 2.0, sign)) columns.push_back(std::move(column));
  return columns;
}

Columns at_motor(Equation, const Frame& f, const Reference& known, Values) {
  return turns(f.motor_angle, known.motor_sign);
}

Columns at_joint(Equation, const Frame& f, const Reference& known, Values) {
  return turns(f.motor_angle, rounded_sign(f.torsion_rate, known.torsion_coulomb_rate));
}

// What a joint shows along its travel: two harmonics of twice the travel.
Columns along_travel(Equation, const Frame& f, const Reference& known, Values) {
  const ArrayXd sign = rounded_sign(f.torsion_rate, known.torsion_coulomb_rate);
  const double low = f.torsion.minCoeff();
  const ArrayXd u = 3.14159265358979323846 * (f.torsion - low) / (f.torsion.maxCoeff() - low);
  return {u.cos() * sign, (2.0 * u).cos() * sign, (3.0 * u).cos() * sign};
}

}  // namespace

CauseRow describe_position_dependent_friction() {
  return {.id = "position_dependent_friction",
          .coordinate = "motor_angle",
          .forms = {
              {.equation = "tau_f += sum_k (a_k sin k theta_m + b_k cos k theta_m) sgn w, k = 1, 2",
               .rigs = {Rig::free},
               .at = {Equation::motor},
               .columns = at_motor},
              {.equation = "tau += sum_k (a_k sin k N q + b_k cos k N q) sgn q', k = 1, 2",
               .rigs = {Rig::specimen},
               .at = {Equation::torsion},
               .columns = at_joint,
               .travels_only = true},
              {.equation = "tau += sum_k a_k cos(k pi s) sgn q', s the share of the travel",
               .rigs = {Rig::specimen},
               .at = {Equation::torsion},
               .columns = along_travel,
               .travels_only = true}}};
}

}  // namespace flexspline::studies
