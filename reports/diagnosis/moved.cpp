#include <cmath>

#include "flexspline/reports/diagnosis_view.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

double sigmas_of(const ShownMove& one) { return std::abs(one.after - one.before) / one.std; }

double percent_of(const ShownMove& one) {
  return 100.0 * (one.after - one.before) / std::abs(one.before);
}

/// By standard deviations where there are any, else by its own size.
double reach_of(const ShownMove& one) {
  return std::isfinite(one.std) ? sigmas_of(one) : 0.01 * std::abs(percent_of(one));
}

std::string sentence_of(const DiagnosisView& view) {
  const ShownMove* most = nullptr;
  for (const ShownMove& one : view.moved) {
    if (!std::isfinite(reach_of(one))) continue;
    if (most == nullptr || reach_of(one) > reach_of(*most)) most = &one;
  }
  if (most == nullptr) return "Parameters of the baseline moved when the causes were modelled.";
  std::string text = "Most of all " + most->name + ", which moved from " + digits(most->before, 3) +
                     " to " + digits(most->after, 3) + " " + most->unit +
                     " when the causes were modelled";
  if (std::isfinite(sigmas_of(*most))) {
    text += ", " + digits(sigmas_of(*most), 2) + " standard deviations";
  }
  return text + ".";
}

std::optional<Section> draw(const DiagnosisView& view) {
  if (view.moved.empty()) return std::nullopt;
  Section section{"moved-section", "What had the baseline absorbed?", {}};
  section.add(Verdict{sentence_of(view)});
  Table table{"moved",
              "Baseline parameters before and after the causes were modelled. What moved far had "
              "had absorbed the missing physics.",
              {{"parameter", "", 3},
               {"before", "", 4},
               {"after", "", 4},
               {"changed by", "%", 2},
               {"std", "", 2},
               {"moved by", "std", 2},
               {"unit", "", 3}},
              {}};
  for (const ShownMove& one : view.moved) {
    table.rows.push_back(
        {one.name, one.before, one.after, percent_of(one), one.std, sigmas_of(one), one.unit});
  }
  section.add(without_empty_columns(std::move(table)));
  return section;
}

}  // namespace

DiagnosisSectionRow describe_moved() { return {60, draw}; }

}  // namespace flexspline::reports
