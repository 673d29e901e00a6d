#include "flexspline/core/effect.hpp"
#include "flexspline/core/stop_operator.hpp"

namespace flexspline {
namespace {

void apply(const EffectSpec& spec, const Motion& motion, std::span<double> torque) {
  for (std::size_t k = 0; k + 1 < spec.parameters.size(); k += 2) {
    const double stiffness = spec.parameters[k].second;
    StopOperator stop(spec.parameters[k + 1].second);
    double last = motion.position.front();
    for (std::size_t i = 0; i < torque.size(); ++i) {
      torque[i] += stiffness * stop.advance(motion.position[i] - last);
      last = motion.position[i];
    }
  }
}

}  // namespace

EffectRow describe_presliding_hysteresis() {
  return {
      .id = "presliding_hysteresis",
      .coordinate = "reversal_memory",
      .equation = "tau += sum_i k_i s_i, s_i' = phi' unless |s_i| = r_i (Maxwell slip)",
      .not_modelled = "drift under a held load; dependence of the yields on load or temperature",
      .parameters = {{"stiffness", "Nm/rad", 0.0, 1e6, 1000.0,
                      "Table I read as rate-independent: half height 4.5 Nm"},
                     {"yield", "rad", 1e-7, 0.1, 3e-4,
                      "catalogue hysteresis of ratio 50: 2 arcmin"}},
      .repeats = true,
      .apply = apply};
}

}  // namespace flexspline
