#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double share = amount * scale.motor_torque / scale.torque;
  const double width = 0.03 * scale.motor_speed;
  const double corner = 0.01 * scale.torque;
  HiddenLaw law;
  law.parameters = {{"coefficient", share * scale.gear->gear_ratio, "1"}};
  law.motor = [=](const MotorPoint& x) {
    const double load = std::sqrt(x.torque * x.torque + corner * corner);
    return share * load * soft_sign(x.velocity, width);
  };
  return law;
}

}  // namespace

HiddenRow describe_load_dependent_friction() {
  return {.id = "load_dependent_friction",
          .coordinate = "load",
          .equation = "tau_m += mu |tau|/N w / sqrt(w^2 + e^2), |tau| rounded at zero",
          .site = HiddenSite::motor,
          .rigs = {Rig::locked, Rig::free, Rig::servo},
          .dissipates = true,
          .make = make};
}

}  // namespace flexspline::data
