#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double swing = amount * scale.friction_torque() / 1.7;
  const double width = 0.03 * scale.friction_speed();
  const double p1 = scale.draw("position_dependent_friction", 0, 0.0, 6.2);
  const double p2 = scale.draw("position_dependent_friction", 1, 0.0, 6.2);
  HiddenLaw law;
  law.parameters = {{"amplitude_order_1", swing, "Nm"}, {"amplitude_order_2", 0.7 * swing, "Nm"}};
  const auto friction = [=](double angle, double speed) {
    const double turn = std::sin(angle + p1) + 0.7 * std::sin(2.0 * angle + p2);
    return swing * turn * soft_sign(speed, width);
  };
  if (scale.travels) {
    law.load = [=, ratio = scale.gear->gear_ratio](const LoadPoint& x) {
      return friction(ratio * x.angle, x.velocity);
    };
  } else {
    law.motor = [=](const MotorPoint& x) { return friction(x.angle, x.velocity); };
  }
  return law;
}

}  // namespace

HiddenRow describe_position_dependent_friction() {
  return {.id = "position_dependent_friction",
          .coordinate = "motor_angle",
          .equation = "tau_m += a (sin(th1 + p1) + 0.7 sin(2 th1 + p2)) w / sqrt(w^2 + e^2)",
          .site = HiddenSite::motor,
          .rigs = {Rig::free, Rig::servo},
          .dissipates = false,
          .make = make,
          .joint = true};
}

}  // namespace flexspline::data
