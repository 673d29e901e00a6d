#include <algorithm>

#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double most = (1.0 - std::min(amount, 0.9)) * scale.torque;
  HiddenLaw law;
  law.parameters = {{"limit", most, "Nm"}};
  law.sensing = [=](HiddenSignals& s) {
    for (double& torque : s.torque) torque = std::clamp(torque, -most, most);
  };
  return law;
}

}  // namespace

HiddenRow describe_unknown_sensor_clipping() {
  return {.id = "unknown:sensor_clipping",
          .coordinate = "load",
          .equation = "y_tau = tau within +-c, else +-c: an amplifier at its rail",
          .site = HiddenSite::torque_sensor,
          .rigs = {Rig::locked, Rig::free},
          .dissipates = false,
          .make = make};
}

}  // namespace flexspline::data
