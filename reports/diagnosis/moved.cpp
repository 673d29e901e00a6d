#include <cmath>

#include "flexspline/reports/diagnosis_view.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

double sigmas_of(const ShownMove& one) { return std::abs(one.after - one.before) / one.std; }

std::string sentence_of(const DiagnosisView& view) {
  const ShownMove* most = nullptr;
  for (const ShownMove& one : view.moved) {
    if (std::isfinite(sigmas_of(one)) && (most == nullptr || sigmas_of(one) > sigmas_of(*most))) {
      most = &one;
    }
  }
  if (most == nullptr) return "Parameters of the baseline moved when the causes were modelled.";
  return "Most of all " + most->name + ", which moved from " + digits(most->before, 3) + " to " +
         digits(most->after, 3) + " " + most->unit + " when the causes were modelled, " +
         digits(sigmas_of(*most), 2) + " standard deviations.";
}

std::optional<Section> draw(const DiagnosisView& view) {
  if (view.moved.empty()) return std::nullopt;
  Section section{"moved-section", "What had the baseline absorbed?", {}};
  section.add(Verdict{sentence_of(view)});
  Table table{"moved",
              "Baseline parameters before and after the causes were modelled. What moved by many "
              "standard deviations had stood in for what was left out.",
              {{"parameter", "", 3},
               {"before", "", 4},
               {"after", "", 4},
               {"std", "", 2},
               {"moved by", "std", 2},
               {"unit", "", 3}},
              {}};
  for (const ShownMove& one : view.moved) {
    table.rows.push_back({one.name, one.before, one.after, one.std, sigmas_of(one), one.unit});
  }
  section.add(without_empty_columns(std::move(table)));
  return section;
}

}  // namespace

DiagnosisSectionRow describe_moved() { return {60, draw}; }

}  // namespace flexspline::reports
