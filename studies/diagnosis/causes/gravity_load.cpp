#include <cmath>

#include "diagnosis/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

Columns pendulum(Equation, const Frame& f, const Reference&, Values) {
  return sine_pair(f.load_angle, 1.0);
}

Counterpart as_moment(const FittedCause& c) {
  auto [amplitude, phase] = std::pair(std::hypot(c.coefficients[0], c.coefficients[1]),
                                      std::atan2(c.coefficients[1], c.coefficients[0]));
  return {.effects = {{"gravity_load", {{"moment", amplitude}, {"phase", phase}}}}};
}

std::vector<Term> terms(const Frame&) {
  return {{"sine", "Nm", "of the torque that goes with the sine of the load angle"},
          {"cosine", "Nm", "with its cosine"}};
}

}  // namespace

CauseRow describe_gravity_load() {
  return {.id = "gravity_load",
          .coordinate = "load_angle",
          .forms = {{.equation = "tau_L += m g l sin(theta_l + a)",
                     .rigs = {Rig::free},
                     .at = {Equation::load},
                     .terms = terms,
                     .columns = pendulum,
                     .counterpart = as_moment}}};
}

}  // namespace flexspline::studies
