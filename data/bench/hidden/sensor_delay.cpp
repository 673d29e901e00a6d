#include "bench/hidden_differences.hpp"
#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double delay = amount * scale.torque / scale.torque_rate;
  HiddenLaw law;
  law.parameters = {{"delay", delay, "s"}};
  law.sensing = [=](HiddenSignals& s) { s.torque = delayed(s.torque, delay / s.step); };
  return law;
}

}  // namespace

HiddenRow describe_sensor_delay() {
  return {.id = "sensor_delay",
          .coordinate = "lag",
          .equation = "y_tau(t) = tau(t - d)",
          .site = HiddenSite::torque_sensor,
          .rigs = {Rig::locked, Rig::free, Rig::specimen},
          .dissipates = false,
          .make = make,
          .joint = true};
}

}  // namespace flexspline::data
