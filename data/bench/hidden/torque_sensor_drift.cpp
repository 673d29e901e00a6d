#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double drift = amount * scale.torque;
  const double time = scale.draw("torque_sensor_drift", 0, 0.3, 1.0) * scale.clock_end;
  HiddenLaw law;
  law.parameters = {{"settling", drift, "Nm"}, {"time_constant", time, "s"}};
  law.sensing = [=](HiddenSignals& s) {
    for (std::size_t k = 0; k < s.size(); ++k) {
      s.torque[k] -= drift * std::expm1(-s.clock(k) / time);
    }
  };
  return law;
}

}  // namespace

HiddenRow describe_torque_sensor_drift() {
  return {.id = "torque_sensor_drift",
          .coordinate = "time",
          .equation = "y_tau = tau + a (1 - exp(-clock/T))",
          .site = HiddenSite::torque_sensor,
          .rigs = {Rig::locked, Rig::free, Rig::specimen},
          .dissipates = false,
          .make = make,
          .joint = true};
}

}  // namespace flexspline::data
