#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double drag = amount * scale.motor_torque;
  const double peak = scale.motor_speed;
  const double power = scale.draw("nonlinear_viscous_friction", 0, 0.5, 0.75);
  HiddenLaw law;
  law.parameters = {{"drag_at_peak_speed", drag, "Nm"}, {"exponent", power, ""}};
  law.motor = [=](const MotorPoint& x) {
    const double y = x.velocity / peak;
    return drag * y * std::pow(y * y + 0.001, 0.5 * (power - 1.0));
  };
  return law;
}

}  // namespace

HiddenRow describe_nonlinear_viscous_friction() {
  return {
      .id = "nonlinear_viscous_friction",
      .coordinate = "velocity",
      .equation = "friction += a y (y^2 + 0.001)^((n-1)/2), y = w / peak speed, n < 1: churning",
      .site = HiddenSite::motor,
      .rigs = {Rig::locked, Rig::free, Rig::servo},
      .dissipates = true,
      .make = make};
}

}  // namespace flexspline::data
