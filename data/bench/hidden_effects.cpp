#include <algorithm>

#include "bench/hidden_by_law.hpp"
#include "flexspline/core/effect.hpp"

namespace flexspline::data {

std::span<const HiddenRow> hidden_effects() {
  static const std::vector<HiddenRow> all = [] {
    const auto written = written_hidden_effects();
    std::vector<HiddenRow> rows(written.begin(), written.end());
    for (const EffectRow& effect : effects()) {
      if (std::ranges::find(written, effect.id, &HiddenRow::id) != written.end()) continue;
      if (auto row = hidden_by_law(effect)) rows.push_back(*std::move(row));
    }
    return rows;
  }();
  return all;
}

}  // namespace flexspline::data
