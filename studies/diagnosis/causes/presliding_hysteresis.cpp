#include "diagnosis/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

constexpr int kElements = 9;

Columns across(Equation, const Frame& f, const Reference&, Values) {
  const double from = f.travels ? 5e-4 : 0.01;
  const double to = f.travels ? 0.1 : 0.7;
  return stop_operators(f, f.torsion,
                        geometric(from * f.torsion_range, to * f.torsion_range, kElements));
}

// The motor travels far: what slips before it slides is a small part of a turn.
Columns at_motor(Equation, const Frame& f, const Reference&, Values) {
  const double range = f.motor_angle.abs().maxCoeff();
  return stop_operators(f, f.motor_angle, geometric(1e-4 * range, 0.3 * range, kElements));
}

}  // namespace

CauseRow describe_presliding_hysteresis() {
  return {.id = "presliding_hysteresis",
          .coordinate = "reversal_memory",
          .forms = {{.equation = "tau += sum_i k_i s_i, s_i' = phi' unless |s_i| = r_i",
                     .rigs = kAnyRig,
                     .at = {Equation::torsion},
                     .columns = across,
                     .nonnegative = true},
                    {.equation = "tau_f += sum_i k_i s_i, s_i' = theta_m' unless |s_i| = r_i",
                     .rigs = kDrives,
                     .at = {Equation::motor},
                     .columns = at_motor,
                     .nonnegative = true}}};
}

}  // namespace flexspline::studies
