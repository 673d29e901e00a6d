#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double peak = scale.torque;
  HiddenLaw law;
  law.parameters = {{"share_at_peak", amount, ""}};
  law.sensing = [=](HiddenSignals& s) {
    for (double& torque : s.torque) torque += amount * torque * torque / peak;
  };
  return law;
}

}  // namespace

HiddenRow describe_unknown_sensor_quadratic() {
  return {.id = "unknown:sensor_quadratic",
          .coordinate = "load",
          .equation = "y_tau = tau + a tau^2/peak: a bridge that is not straight",
          .site = HiddenSite::torque_sensor,
          .rigs = {Rig::locked, Rig::free},
          .dissipates = false,
          .make = make};
}

}  // namespace flexspline::data
