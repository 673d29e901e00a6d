#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double excess = amount * scale.friction_torque();
  const double stribeck = scale.draw("stribeck_friction", 0, 0.1, 0.25) * scale.friction_speed();
  HiddenLaw law;
  law.parameters = {{"static_excess", excess, "Nm"}, {"half_excess_speed", stribeck, "rad/s"}};
  put_friction(law, scale, [=](double speed, double) {
    const double ratio = speed / stribeck;
    return excess * soft_sign(speed, 0.1 * stribeck) / (1.0 + ratio * ratio);
  });
  return law;
}

}  // namespace

HiddenRow describe_stribeck_friction() {
  return {.id = "stribeck_friction",
          .coordinate = "velocity",
          .equation = "friction += a s / (1 + (w/w_s)^2), s = w / sqrt(w^2 + e^2)",
          .site = HiddenSite::motor,
          .rigs = {Rig::locked, Rig::free, Rig::specimen, Rig::servo},
          .dissipates = true,
          .make = make,
          .joint = true};
}

}  // namespace flexspline::data
