#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

HiddenLaw make(const HiddenScale& scale, double amount) {
  HiddenLaw law;
  law.parameters = {{"error", 1.0 / (1.0 + amount) - 1.0, "1"}};
  static_cast<void>(scale);
  law.sensing = [=](HiddenSignals& s) {
    for (double& torque : s.motor_torque) torque *= 1.0 + amount;
  };
  return law;
}

}  // namespace

HiddenRow describe_torque_constant_error() {
  return {.id = "torque_constant_error",
          .coordinate = "load",
          .equation = "y_m = (1 + a) tau_m",
          .site = HiddenSite::motor_sensor,
          .rigs = {Rig::locked, Rig::free, Rig::servo},
          .dissipates = false,
          .make = make};
}

}  // namespace flexspline::data
