#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double crosstalk = 0.5 * amount * scale.torque;
  const double phase = scale.draw("sensor_crosstalk", 0, 0.0, 6.2);
  HiddenLaw law;
  law.parameters = {{"amplitude_order_2", crosstalk, "Nm"}};
  law.sensing = [=](HiddenSignals& s) {
    for (std::size_t k = 0; k < s.size(); ++k) {
      s.torque[k] += crosstalk * (std::sin(2.0 * s.motor_angle[k] + phase) - std::sin(phase));
    }
  };
  return law;
}

}  // namespace

HiddenRow describe_sensor_crosstalk() {
  return {.id = "sensor_crosstalk",
          .coordinate = "motor_angle",
          .equation = "y_tau = tau + a (sin(2 th1 + p) - sin p)",
          .site = HiddenSite::torque_sensor,
          .rigs = {Rig::free},
          .dissipates = false,
          .make = make};
}

}  // namespace flexspline::data
