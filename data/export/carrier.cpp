#include "export/carrier.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "flexspline/core/effect_path.hpp"

namespace flexspline::data {
namespace {

bool same(const EffectSpec& a, const EffectSpec& b) {
  return a.effect == b.effect && a.parameters == b.parameters && a.across == b.across;
}

void take_out(RigModel& model, const EffectSpec& effect) {
  auto& effects = model.drive.torsion.effects;
  const auto at = std::ranges::find_if(effects, [&](const auto& e) { return same(e, effect); });
  if (at != effects.end()) effects.erase(at);
}

}  // namespace

std::string in_words(const EffectSpec& effect) {
  std::string text = effect.effect + " (";
  for (std::size_t k = 0; k < effect.parameters.size(); ++k) {
    text += fmt::format("{}{} {:.4g}", k == 0 ? "" : ", ", effect.parameters[k].first,
                        effect.parameters[k].second);
  }
  return text + ")";
}

void Carrier::drop_effects(
    const std::function<std::string(const EffectRow&, const EffectSpec&)>& reason) {
  const auto effects = carried_.model.drive.torsion.effects;
  for (const EffectSpec& effect : effects) {
    const auto row = find_effect(effect.effect);
    if (!row) continue;
    const std::string why = reason(**row, effect);
    if (why.empty()) continue;
    take_out(carried_.model, effect);
    Lost lost{in_words(effect), why, whole_, on_instrument(site_of(**row, effect))};
    take_out(lost.without, effect);
    carried_.lost.push_back(std::move(lost));
  }
}

void Carrier::drop_instruments() {
  drop_effects([](const EffectRow& row, const EffectSpec& effect) {
    return on_instrument(site_of(row, effect))
               ? std::string("it belongs to the recording, not to the machine")
               : std::string();
  });
}

void Carrier::change(const std::string& what, const std::string& why,
                     const std::function<void(RigModel&)>& by,
                     const std::function<bool(const RigModel&)>& needed) {
  if (!needed(carried_.model)) return;
  by(carried_.model);
  Lost lost{what, why, whole_};
  by(lost.without);
  carried_.lost.push_back(std::move(lost));
}

}  // namespace flexspline::data
