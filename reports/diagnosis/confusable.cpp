#include <cmath>

#include "flexspline/reports/diagnosis_view.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

Table confusable_table(const DiagnosisView& view) {
  Table table{"confusable",
              "How alike effects look on these recordings once the baseline has taken what it can: "
              "0 is nothing in common, 1 is the same signal.",
              {{"effect", "", 3}, {"looks like", "", 3}, {"similarity", "", 2}, {"why", "", 3}},
              {}};
  for (const ShownConfusable& one : view.confusable) {
    table.rows.push_back({words(one.effect), words(one.with), one.similarity, one.why});
  }
  return table;
}

std::string joined(const std::vector<std::string>& ids) {
  std::string text;
  for (std::size_t i = 0; i < ids.size(); ++i) text += (i == 0 ? "" : " from ") + words(ids[i]);
  return text;
}

std::string experiment_sentence(const DiagnosisView& view) {
  const ShownExperiment& next = *view.next;
  std::string text = "In numbers: " + next.excitation;
  if (std::isfinite(next.amplitude)) {
    text += ", amplitude " + compact(next.amplitude, 3) + " " + view.units.motion;
  }
  if (std::isfinite(next.frequency_hz)) text += ", " + compact(next.frequency_hz, 3) + " Hz";
  if (!next.separates.empty()) text += ", would separate " + joined(next.separates);
  if (std::isfinite(next.separation_sigma)) {
    text += " by " + digits(next.separation_sigma, 2) + " standard deviations";
  }
  return text + ".";
}

std::optional<Section> draw(const DiagnosisView& view) {
  if (view.confusable.empty() && !view.next) return std::nullopt;
  Section section{
      "confusable-section", "What could it be confused with, and what would settle it?", {}};
  if (view.next) {
    section.add(
        Verdict{view.next->says.empty() ? experiment_sentence(view) : sentence(view.next->says)});
    if (!view.next->says.empty()) section.add(Paragraph{experiment_sentence(view)});
  }
  if (!view.confusable.empty()) section.add(confusable_table(view));
  return section;
}

}  // namespace

DiagnosisSectionRow describe_confusable() { return {50, draw}; }

}  // namespace flexspline::reports
