#include "diagnosis/model/cause_columns.hpp"

namespace flexspline::studies {
namespace {

using Eigen::ArrayXd;
using Values = std::span<const double>;

std::vector<Shape> skew(const Frame& f) {
  const double most = f.torsion_range / f.load_speed.abs().maxCoeff();
  return {{.name = "delay",
           .unit = "s",
           .lower = -most,
           .upper = most,
           .logarithmic = false,
           .meaning = "by which it is late"}};
}

std::vector<double> none(const Frame&) { return {0.0}; }

// The load's angle is read late by d: it has moved on by w_l d.
void load_late(Frame& f, Values shape) {
  f.torsion -= shape[0] * f.load_speed;
  f.torsion_rate -= shape[0] * f.load_acceleration;
  f.load_speed += shape[0] * f.load_acceleration;
  f.load_acceleration = later(f, f.load_acceleration, shape[0]);
}

Counterpart as_skew(const FittedCause& c) {
  return {.effects = {{"encoder_skew", {{"delay", c.shape[0]}}}}};
}

}  // namespace

CauseRow describe_encoder_skew() {
  return {.id = "encoder_skew",
          .coordinate = "lag",
          .forms = {{.equation = "theta_l,measured(t) = theta_l(t - d)",
                     .rigs = {Rig::free},
                     .at = {Equation::torsion, Equation::load},
                     .shapes = skew,
                     .transform = load_late,
                     .start = none,
                     .counterpart = as_skew}}};
}

}  // namespace flexspline::studies
