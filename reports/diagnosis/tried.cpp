#include <algorithm>

#include "figures/diagnosis_figures.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

/// By round, the candidate that removes most first; where there is nothing to remove, as they
/// stand.
std::vector<ShownCandidate> ranked(const DiagnosisView& view) {
  std::vector<ShownCandidate> tried = view.tried;
  std::stable_sort(tried.begin(), tried.end(), [&](const auto& a, const auto& b) {
    if (a.round != b.round) return a.round < b.round;
    return !view.adequate() && a.misfit_removed > b.misfit_removed;
  });
  return tried;
}

/// Shares of a misfit that is not there say nothing.
void blank_misfit(Table& table) {
  constexpr std::size_t kMisfit = 2;
  for (auto& row : table.rows) row[kMisfit] = kAbsent;
}

Table tried_table(const DiagnosisView& view) {
  Table table{
      "tried",
      "Every candidate that was tried, by round of the search, with the reason where it was "
      "rejected.",
      {{"round", "", 0},
       {"candidate", "", 3},
       {"misfit removed", "%", 2},
       {"delta BIC", "", 3},
       {"hold-out ratio", "", 3},
       {"outcome", "", 3}},
      {}};
  for (const ShownCandidate& one : ranked(view)) {
    table.rows.push_back({std::to_string(one.round), words(one.effect), 100.0 * one.misfit_removed,
                          one.delta_bic, one.holdout_ratio, one.outcome});
  }
  if (view.adequate()) blank_misfit(table);
  return without_empty_columns(std::move(table));
}

std::string summary_of(const DiagnosisView& view) {
  std::vector<std::string> names;
  for (const ShownCandidate& one : view.tried) {
    if (std::find(names.begin(), names.end(), one.effect) == names.end()) {
      names.push_back(one.effect);
    }
  }
  const std::size_t accepted = view.causes.size();
  return std::to_string(names.size()) + " effects of the catalogue were tried; " +
         (accepted == 0 ? "none was"
                        : std::to_string(accepted) + (accepted == 1 ? " was" : " were")) +
         " accepted.";
}

std::optional<Section> draw(const DiagnosisView& view) {
  if (view.tried.empty()) return std::nullopt;
  Section section{"tried-section", "What was tried, and why was the rest rejected?", {}};
  section.add(Verdict{summary_of(view)});
  if (Figure figure = candidates_figure(view); !figure.frames.empty()) {
    section.add(std::move(figure));
  }
  section.add(tried_table(view));
  return section;
}

}  // namespace

DiagnosisSectionRow describe_tried() { return {30, draw}; }

}  // namespace flexspline::reports
