#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double offset = amount * scale.motor_torque;
  HiddenLaw law;
  law.parameters = {{"offset", offset, "Nm"}};
  law.sensing = [=](HiddenSignals& s) {
    for (double& torque : s.motor_torque) torque += offset;
  };
  return law;
}

}  // namespace

HiddenRow describe_motor_torque_offset() {
  return {.id = "motor_torque_offset",
          .coordinate = "constant",
          .equation = "y_m = tau_m + a",
          .site = HiddenSite::motor_sensor,
          .rigs = {Rig::locked, Rig::free, Rig::servo},
          .dissipates = false,
          .make = make};
}

}  // namespace flexspline::data
