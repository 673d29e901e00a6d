#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "diagnosis/model/cause_columns.hpp"
#include "diagnosis/model/model.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

// m g l sin(theta + a) = m g l (cos a sin theta + sin a cos theta); the baseline has the first.
Columns beside_gravity(Equation, const Frame& f, const Reference&, Values) {
  return {f.pendulum_moment() * f.load_angle.cos()};
}

Counterpart as_moment(const FittedCause& c) {
  const double moment = c.coefficients[0] * c.frame.ratio * c.frame.pendulum_moment();
  const double phase = std::copysign(0.5 * std::numbers::pi, moment);
  return {.effects = {{"gravity_load", {{"moment", std::abs(moment)}, {"phase", phase}}}}};
}

std::vector<Term> terms(const Frame&) {
  return {
      {"sine", "1", "of the angle at which the arm hangs, over the share of gravity that acts"}};
}

std::string in_words(const Frame&, const DriveModel& model, std::size_t cause) {
  const Eigen::VectorXd& own = model.own[index_of(Equation::motor)];
  const double gravity = own[own.size() - 2];  // before the load's inertia
  return fmt::format("the arm hangs at {:.2g} deg of its encoder",
                     -std::atan2(model.coefficients[cause][0], gravity) * 180.0 / std::numbers::pi);
}

}  // namespace

CauseRow describe_arm_zero() {
  return {.id = "arm_zero",
          .coordinate = "load_angle",
          .forms = {{.equation = "m g l sin(theta_l + a)",
                     .rigs = {Rig::servo},
                     .at = {Equation::motor},
                     .terms = terms,
                     .columns = beside_gravity,
                     .counterpart = as_moment}},
          .part = BaselinePart{.says = in_words}};
}

}  // namespace flexspline::studies
