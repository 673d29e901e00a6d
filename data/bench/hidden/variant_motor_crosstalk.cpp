#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double crosstalk = 0.5 * amount * scale.motor_torque;
  const double phase = scale.draw("variant:motor_crosstalk", 0, 0.0, 6.2);
  HiddenLaw law;
  law.parameters = {{"amplitude_order_2", crosstalk, "Nm"}};
  law.sensing = [=](HiddenSignals& s) {
    for (std::size_t k = 0; k < s.size(); ++k) {
      s.motor_torque[k] += crosstalk * std::sin(2.0 * s.motor_angle[k] + phase);
    }
  };
  return law;
}

}  // namespace

HiddenRow describe_variant_motor_crosstalk() {
  return {
      .id = "variant:motor_crosstalk",
      .coordinate = "motor_angle",
      .equation = "y_m = tau_m + a sin(2 th1 + p): the channel, not the shaft, ripples",
      .site = HiddenSite::motor_sensor,
      .rigs = {Rig::free, Rig::servo},
      .dissipates = false,
      .make = make,
      .names = {"motor_torque_ripple"}};
}

}  // namespace flexspline::data
