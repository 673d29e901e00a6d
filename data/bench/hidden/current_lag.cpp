#include "bench/hidden_differences.hpp"
#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double time = amount * scale.motor_torque / scale.motor_torque_rate;
  HiddenLaw law;
  law.parameters = {{"time_constant", time, "s"}};
  law.sensing = [=](HiddenSignals& s) {
    const std::vector<double> rate = slopes(s.motor_torque, s.step);
    for (std::size_t k = 0; k < s.size(); ++k) s.motor_torque[k] += time * rate[k];
  };
  return law;
}

}  // namespace

HiddenRow describe_current_lag() {
  return {.id = "current_lag",
          .coordinate = "lag",
          .equation = "y_m = tau_m + T tau_m': the command, which the current follows late",
          .site = HiddenSite::motor_sensor,
          .rigs = {Rig::locked, Rig::free, Rig::servo},
          .dissipates = false,
          .make = make};
}

}  // namespace flexspline::data
