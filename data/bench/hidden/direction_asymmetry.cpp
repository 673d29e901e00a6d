#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double extra = amount * scale.friction_torque();
  const double width = 0.03 * scale.friction_speed();
  HiddenLaw law;
  law.parameters = {{"forward_excess", extra, "Nm"}};
  put_friction(law, scale, [=](double speed, double) {
    const double sign = soft_sign(speed, width);
    return 0.5 * extra * sign * (1.0 + sign);
  });
  return law;
}

}  // namespace

HiddenRow describe_direction_asymmetry() {
  return {
      .id = "direction_asymmetry",
      .coordinate = "velocity",
      .equation = "friction += a s (1 + s)/2, s = w / sqrt(w^2 + e^2): more in the one direction",
      .site = HiddenSite::motor,
      .rigs = {Rig::locked, Rig::free, Rig::specimen, Rig::servo},
      .dissipates = true,
      .make = make,
      .joint = true};
}

}  // namespace flexspline::data
