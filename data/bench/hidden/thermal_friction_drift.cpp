#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double cold = amount * scale.friction_torque();
  const double width = 0.03 * scale.friction_speed();
  const double time = scale.draw("thermal_friction_drift", 0, 0.25, 0.5) * scale.clock_end;
  HiddenLaw law;
  law.parameters = {{"cold_friction", cold, "Nm"}, {"time_constant", time, "s"}};
  put_friction(law, scale, [=](double speed, double clock) {
    return cold * std::exp(-clock / time) * soft_sign(speed, width);
  });
  return law;
}

}  // namespace

HiddenRow describe_thermal_friction_drift() {
  return {.id = "thermal_friction_drift",
          .coordinate = "time",
          .equation = "friction += a exp(-clock/T) w / sqrt(w^2 + e^2): a cold bench that warms up",
          .site = HiddenSite::motor,
          .rigs = {Rig::locked, Rig::free, Rig::specimen, Rig::servo},
          .dissipates = true,
          .make = make,
          .joint = true};
}

}  // namespace flexspline::data
