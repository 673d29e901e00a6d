#include "diagnosis/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

Columns pendulum(Equation, const Frame& f, const Reference&, Values) {
  return sine_pair(f.load_angle, 1.0);
}

}  // namespace

CauseRow describe_gravity_load() {
  return {.id = "gravity_load",
          .coordinate = "load_angle",
          .forms = {{.equation = "tau_L += m g l sin(theta_l + a)",
                     .rigs = {Rig::free},
                     .at = {Equation::load},
                     .columns = pendulum}}};
}

}  // namespace flexspline::studies
