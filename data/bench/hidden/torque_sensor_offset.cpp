#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double offset = amount * scale.torque;
  HiddenLaw law;
  law.parameters = {{"offset", offset, "Nm"}};
  law.sensing = [=](HiddenSignals& s) {
    for (double& torque : s.torque) torque += offset;
  };
  return law;
}

}  // namespace

HiddenRow describe_torque_sensor_offset() {
  return {.id = "torque_sensor_offset",
          .coordinate = "constant",
          .equation = "y_tau = tau + a",
          .site = HiddenSite::torque_sensor,
          .rigs = {Rig::locked, Rig::free},
          .dissipates = false,
          .make = make};
}

}  // namespace flexspline::data
