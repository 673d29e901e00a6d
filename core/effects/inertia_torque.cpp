#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

void apply(const EffectSpec& spec, const Motion& motion, std::span<double> torque) {
  const double inertia = spec.parameters[0].second;
  for (std::size_t i = 0; i < torque.size(); ++i) torque[i] += inertia * motion.acceleration[i];
}

}  // namespace

EffectRow describe_inertia_torque() {
  return {.id = "inertia_torque",
          .coordinate = "acceleration",
          .equation = "tau += J phi''",
          .not_modelled = "an inertia that moves with another shaft than the motion measured",
          .parameters = {{"inertia", "kg m2", -100.0, 100.0, 1.815,
                          "N^2 (J_motor + J_wave_generator), Table II"}},
          .apply = apply};
}

}  // namespace flexspline
