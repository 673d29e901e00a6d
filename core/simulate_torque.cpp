#include <algorithm>
#include <optional>

#include "flexspline/core/effect_path.hpp"
#include "flexspline/core/law.hpp"
#include "flexspline/core/simulate.hpp"
#include "yielding_torque.hpp"

namespace flexspline {
namespace {

// What opposes the motion, what the torque sensor adds to it, and what becomes of its signal.
enum class Stage { force, reading, signal };

std::optional<Stage> stage_of(const EffectRow& row) {
  if (row.site == Site::torque_signal) return row.map == nullptr ? Stage::reading : Stage::signal;
  const bool force = !on_instrument(row.site) && row.site != Site::kinematics;
  return force ? std::optional(Stage::force) : std::nullopt;
}

Result<void> apply_effects(const ModelSpec& model, std::span<const Instant<double>> path,
                           std::span<double> torque, Stage stage) {
  for (const EffectSpec& spec : model.effects) {
    const auto row = find_effect(spec.effect);
    if (!row) return tl::unexpected(row.error());
    if (stage_of(**row) != stage) continue;
    if (auto done = apply_along(**row, spec, path, torque); !done) return done;
  }
  return {};
}

// Kinematics add to the torsion that the law sees; its rate by differences of what they add.
Result<void> add_kinematics(const ModelSpec& model, std::span<Instant<double>> path) {
  std::vector<double> added(path.size(), 0.0);
  for (const EffectSpec& spec : model.effects) {
    const auto row = find_effect(spec.effect);
    if (!row) return tl::unexpected(row.error());
    if ((*row)->site != Site::kinematics) continue;
    if (auto done = apply_along(**row, spec, path, added); !done) return done;
  }
  for (std::size_t i = 0; i < path.size(); ++i) {
    const std::size_t before = i > 0 ? i - 1 : 0;
    const std::size_t after = std::min(i + 1, path.size() - 1);
    path[i].torsion += added[i];
    if (after == before) continue;
    path[i].torsion_rate += (added[after] - added[before]) / (path[after].time - path[before].time);
  }
  return {};
}

Result<std::vector<double>> with_stages(const ModelSpec& model, std::span<Instant<double>> path,
                                        std::vector<double> torque,
                                        std::initializer_list<Stage> stages) {
  for (const Stage stage : stages) {
    set_torque(path, torque);
    if (auto done = apply_effects(model, path, torque, stage); !done) {
      return tl::unexpected(done.error());
    }
  }
  return torque;
}

}  // namespace

Result<std::vector<double>> simulate_torque(const ModelSpec& model, const Motion& motion) {
  const auto f = make_law(model.f);
  const auto g_inverse = make_law(model.g_inverse);
  const auto h = make_law(model.h);
  for (const auto* law : {&f, &g_inverse, &h}) {
    if (!*law) return tl::unexpected(law->error());
  }
  auto path = instants_of(motion);
  const auto yields = kinematics_follow_torque(model);
  if (!yields) return tl::unexpected(yields.error());
  if (*yields) {
    auto torque = torque_of_yielding({**f, **g_inverse, **h}, model, path);
    if (!torque) return torque;
    return with_stages(model, path, std::move(*torque), {Stage::reading, Stage::signal});
  }
  if (auto done = add_kinematics(model, path); !done) return tl::unexpected(done.error());
  std::vector<double> torque(path.size());
  for (std::size_t i = 0; i < torque.size(); ++i) {
    const double phi = path[i].torsion;
    torque[i] = (*f)->value(phi) + (*g_inverse)->value(path[i].torsion_rate / (*h)->value(phi));
  }
  return with_stages(model, path, std::move(torque), {Stage::force, Stage::reading, Stage::signal});
}

}  // namespace flexspline
