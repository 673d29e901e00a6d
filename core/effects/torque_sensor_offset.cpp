#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

void apply(const EffectSpec& spec, const Motion&, std::span<double> torque) {
  for (double& value : torque) value += spec.parameters[0].second;
}

}  // namespace

EffectRow describe_torque_sensor_offset() {
  return {.id = "torque_sensor_offset",
          .coordinate = "constant",
          .equation = "tau_measured = tau + o",
          .not_modelled = "drift of the offset",
          .parameters = {{"offset", "Nm", -1e3, 1e3, 0.5, "0.1 to 0.5 % of full scale"}},
          .on_instrument = true,
          .apply = apply};
}

}  // namespace flexspline
