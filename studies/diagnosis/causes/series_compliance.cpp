#include "diagnosis/model/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

std::vector<Shape> compliance(const Frame& f) {
  const double whole = f.torsion_range / f.torque_range;
  return {{.name = "compliance",
           .unit = "rad/Nm",
           .lower = 0.01 * whole,
           .upper = 0.7 * whole,
           .grid = 4,
           .meaning = "torsion over torque of what is in series"}};
}

void in_series(Frame& f, Values shape) {
  f.torsion -= shape[0] * f.smooth_torque;
  f.torsion_rate -= shape[0] * f.torque_rate;
}

Counterpart as_compliance(const FittedCause& c) {
  return {.effects = {{"series_compliance", {{"compliance", c.shape[0]}}}}};
}

}  // namespace

CauseRow describe_series_compliance() {
  return {.id = "series_compliance",
          .coordinate = "torsion",
          .forms = {{.equation = "phi = theta_m/N - theta_l - tau/K_s",
                     .rigs = kDrives,
                     .at = {Equation::torsion},
                     .shapes = compliance,
                     .transform = in_series,
                     .counterpart = as_compliance}}};
}

}  // namespace flexspline::studies
