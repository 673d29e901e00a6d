#include "diagnosis/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

std::vector<Shape> turns(const Frame&) {
  return {{.name = "order", .unit = "1", .lower = 1.0, .upper = 4.0, .discrete = true}};
}

Columns at_motor(Equation, const Frame& f, const Reference& known, Values shape) {
  return sine_pair(f.motor_angle, shape[0], rounded_sign(f.motor_speed, known.motor_coulomb_speed));
}

Columns at_joint(Equation, const Frame& f, const Reference& known, Values shape) {
  return sine_pair(f.motor_angle, shape[0],
                   rounded_sign(f.torsion_rate, known.torsion_coulomb_rate));
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
          .forms = {{.equation = "tau_f += (a sin k theta_m + b cos k theta_m) sgn w",
                     .rigs = {Rig::free},
                     .at = {Equation::motor},
                     .shapes = turns,
                     .columns = at_motor},
                    {.equation = "tau += (a sin k N q + b cos k N q) sgn q'",
                     .rigs = {Rig::specimen},
                     .at = {Equation::torsion},
                     .shapes = turns,
                     .columns = at_joint,
                     .travels_only = true},
                    {.equation = "tau += sum_k a_k cos(k pi s) sgn q', s the share of the travel",
                     .rigs = {Rig::specimen},
                     .at = {Equation::torsion},
                     .columns = along_travel,
                     .travels_only = true}}};
}

}  // namespace flexspline::studies
