#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double ripple = amount * scale.motor_torque;
  const double share = 0.5 * amount;
  const double phase = scale.draw("motor_torque_ripple", 0, 0.0, 6.2);
  HiddenLaw law;
  law.parameters = {{"amplitude", ripple, "Nm"}, {"ripple_share", share, ""}};
  law.motor = [=](const MotorPoint& x) {
    return ripple * std::sin(4.0 * x.angle) + share * x.drive * std::sin(6.0 * x.angle + phase);
  };
  return law;
}

}  // namespace

HiddenRow describe_motor_torque_ripple() {
  return {.id = "motor_torque_ripple",
          .coordinate = "motor_angle",
          .equation =
              "tau_m += a sin(4 th1) + 0.5 a (tau_m/peak) sin(6 th1 + p): cogging and commutation",
          .site = HiddenSite::motor,
          .rigs = {Rig::free, Rig::servo},
          .dissipates = false,
          .make = make};
}

}  // namespace flexspline::data
