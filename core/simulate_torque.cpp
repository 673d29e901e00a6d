#include <algorithm>

#include "flexspline/core/effect_path.hpp"
#include "flexspline/core/law.hpp"
#include "flexspline/core/simulate.hpp"

namespace flexspline {
namespace {

Result<void> apply_effects(const ModelSpec& model, std::span<const Instant<double>> path,
                           std::span<double> torque, bool instrument) {
  for (const EffectSpec& spec : model.effects) {
    const auto row = find_effect(spec.effect);
    if (!row) return tl::unexpected(row.error());
    if (on_instrument((*row)->site) != instrument) continue;
    if (auto done = apply_along(**row, spec, path, torque); !done) return done;
  }
  return {};
}

}  // namespace

Result<std::vector<double>> simulate_torque(const ModelSpec& model, const Motion& motion) {
  const auto f = make_law(model.f);
  const auto g_inverse = make_law(model.g_inverse);
  const auto h = make_law(model.h);
  for (const auto* law : {&f, &g_inverse, &h}) {
    if (!*law) return tl::unexpected(law->error());
  }
  std::vector<double> torque(motion.position.size());
  for (std::size_t i = 0; i < torque.size(); ++i) {
    const double phi = motion.position[i];
    torque[i] = (*f)->value(phi) + (*g_inverse)->value(motion.velocity[i] / (*h)->value(phi));
  }
  auto path = instants_of(motion);
  for (bool instrument : {false, true}) {
    set_torque(path, torque);
    if (auto done = apply_effects(model, path, torque, instrument); !done) {
      return tl::unexpected(done.error());
    }
  }
  return torque;
}

}  // namespace flexspline
