#include "diagnosis/model/cause.hpp"

#include <algorithm>

#include "diagnosis/model/cause_by_law.hpp"

namespace flexspline::studies {

std::span<const CauseRow> causes() {
  static const std::vector<CauseRow> all = [] {
    const auto written = written_causes();
    std::vector<CauseRow> rows(written.begin(), written.end());
    for (const EffectRow& effect : effects()) {
      if (std::ranges::find(written, effect.id, &CauseRow::id) != written.end()) continue;
      if (auto row = cause_by_law(effect)) rows.push_back(*std::move(row));
    }
    std::ranges::sort(rows, {}, &CauseRow::id);
    return rows;
  }();
  return all;
}

Equation first_equation(const Frame& frame, const CauseForm& form) {
  for (Equation e : form.at) {
    if (frame.has(e)) return e;
  }
  return form.at.front();
}

std::vector<const CauseForm*> forms_on(const CauseRow& row, const Frame& frame) {
  std::vector<const CauseForm*> list;
  for (const CauseForm& form : row.forms) {
    const bool exists = std::ranges::count(form.rigs, frame.rig) > 0;
    const bool seen =
        std::ranges::any_of(form.at, [&](Equation equation) { return frame.has(equation); });
    const bool fits = form.where == nullptr || form.where(frame);
    if (exists && seen && fits) list.push_back(&form);
  }
  return list;
}

}  // namespace flexspline::studies
