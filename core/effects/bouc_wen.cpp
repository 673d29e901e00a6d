#include <algorithm>
#include <cmath>

#include "flexspline/core/effect.hpp"

namespace flexspline {
namespace {

// dz/d(x/r) where the motion goes in this direction.
double slope(double z, double direction, double exponent) {
  const double along = z * direction;
  return 1.0 - std::copysign(std::pow(std::min(std::abs(along), 1.0), exponent), along);
}

// Within one sample z follows its equation by Heun steps of at most a twentieth of the slip length,
// so that the result does not depend on the sampling.
void apply(const EffectSpec& spec, const Motion& motion, std::span<double> torque) {
  const double height = spec.parameters[0].second;
  const double slip = spec.parameters[1].second;
  const double exponent = spec.parameters[2].second;
  double z = 0.0;
  double last = motion.position.front();
  for (std::size_t i = 0; i < torque.size(); ++i) {
    const double dx = motion.position[i] - last;
    last = motion.position[i];
    const double direction = dx < 0.0 ? -1.0 : 1.0;
    const int steps = static_cast<int>(std::clamp(std::ceil(20.0 * std::abs(dx) / slip), 1.0, 1e4));
    const double step = dx / (slip * steps);
    for (int k = 0; k < steps; ++k) {
      const double first = slope(z, direction, exponent);
      const double second = slope(z + step * first, direction, exponent);
      z = std::clamp(z + 0.5 * step * (first + second), -1.0, 1.0);
    }
    torque[i] += height * z;
  }
}

}  // namespace

EffectRow describe_bouc_wen() {
  return {.id = "bouc_wen",
          .coordinate = "reversal_memory",
          .equation = "tau += H z, z' = phi'/r (1 - sgn(z phi') |z|^n)",
          .not_modelled = "closed minor loops: one state forgets where it turned",
          .parameters = {{"height", "Nm", 0.0, 1e4, 4.5, "Table I's half height"},
                         {"slip_length", "rad", 1e-7, 0.1, 3e-4,
                          "catalogue hysteresis of ratio 50: 2 arcmin"},
                         {"exponent", "1", 0.2, 5.0, 1.0, "Dahl (1968) at 1; Wen (1976)"}},
          .apply = apply};
}

}  // namespace flexspline
