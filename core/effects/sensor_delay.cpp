#include <vector>

#include "flexspline/core/effect.hpp"
#include "flexspline/core/spline.hpp"

namespace flexspline {
namespace {

void apply(const EffectSpec& spec, const Motion& motion, std::span<double> torque) {
  const double delay = spec.parameters[0].second;
  if (delay == 0.0) return;
  const Spline sampled(motion.time, torque);
  for (std::size_t i = 0; i < torque.size(); ++i) {
    torque[i] = sampled.value(motion.time[i] - delay);
  }
}

}  // namespace

EffectRow describe_sensor_delay() {
  return {.id = "sensor_delay",
          .coordinate = "lag",
          .equation = "tau_measured(t) = tau(t - d)",
          .not_modelled = "filters whose delay depends on frequency",
          .parameters = {{"delay", "s", -1.0, 1.0, 1e-3, "anti-alias filters: 0.5 to 5 ms"}},
          .on_instrument = true,
          .apply = apply};
}

}  // namespace flexspline
