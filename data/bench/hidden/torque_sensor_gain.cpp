#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

HiddenLaw make(const HiddenScale& scale, double amount) {
  HiddenLaw law;
  law.parameters = {{"error", amount, "1"}};
  static_cast<void>(scale);
  law.sensing = [=](HiddenSignals& s) {
    for (double& torque : s.torque) torque *= 1.0 + amount;
  };
  return law;
}

}  // namespace

HiddenRow describe_torque_sensor_gain() {
  return {.id = "torque_sensor_gain",
          .coordinate = "load",
          .equation = "y_tau = (1 + a) tau",
          .site = HiddenSite::torque_sensor,
          .rigs = {Rig::locked, Rig::free},
          .dissipates = false,
          .make = make};
}

}  // namespace flexspline::data
