#include <algorithm>

#include <fmt/format.h>

#include "flexspline/core/law.hpp"
#include "flexspline/core/simulate.hpp"

namespace flexspline {
namespace {

Result<void> apply_effects(const ModelSpec& model, const Motion& motion, std::span<double> torque,
                           bool on_instrument) {
  for (const EffectSpec& spec : model.effects) {
    const auto row = find_effect(spec.effect);
    if (!row) return tl::unexpected(row.error());
    if ((*row)->on_instrument != on_instrument) continue;
    const std::size_t group = (*row)->parameters.size();
    const std::size_t given = spec.parameters.size();
    if ((*row)->repeats ? given % group != 0 : given != group) {
      return failure(ErrorCode::bad_data,
                     fmt::format("effect {} has {} parameters", spec.effect, given),
                     fmt::format("it takes {}{}", group, (*row)->repeats ? " an element" : ""));
    }
    (*row)->apply(spec, motion, torque);
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
  if (auto done = apply_effects(model, motion, torque, false); !done) {
    return tl::unexpected(done.error());
  }
  if (auto done = apply_effects(model, motion, torque, true); !done) {
    return tl::unexpected(done.error());
  }
  return torque;
}

}  // namespace flexspline
