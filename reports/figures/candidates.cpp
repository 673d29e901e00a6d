#include <algorithm>
#include <cmath>
#include <map>

#include "extent.hpp"
#include "figures/diagnosis_figures.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

/// Place of a name among the categories, which gain it where they have it not.
double row_of(std::vector<std::string>& categories, const std::string& name) {
  const auto found = std::find(categories.begin(), categories.end(), name);
  const auto row = static_cast<double>(found - categories.begin());
  if (found == categories.end()) categories.push_back(name);
  return row;
}

/// Zero is what the criterion is compared with.
void show_zero(Panel& panel) {
  Extent extent;
  extent.take(0.0);
  for (const Series& series : panel.series) extent.take(series.x);
  panel.x.range = widened(extent.lower, extent.upper, 0.05);
  panel.marks.push_back({0.0, "no change"});
}

}  // namespace

Figure candidates_figure(const DiagnosisView& view) {
  Figure figure;
  figure.id = "candidates";
  figure.kind = "scatter";
  figure.title = "What each candidate would explain";
  figure.caption =
      view.adequate()
          ? "Change of the information criterion (BIC) by each candidate. Left of zero it would be "
            "significant for its number of parameters; there is none that is and that holds on "
            "recordings not seen."
          : "Share of the misfit beyond the noise that a candidate removes, by round of the "
            "search. "
            "The best one of a round is accepted only if it also holds on recordings that it has "
            "not seen; those close to it are what it could be confused with.";
  figure.alt = "What every candidate would explain, a symbol a round.";
  Panel panel;
  panel.x.label = view.adequate() ? "delta BIC" : "misfit removed / %";
  panel.y.label = "candidate";
  std::map<int, Series> rounds;
  for (const ShownCandidate& one : view.tried) {
    const double worth = view.adequate() ? one.delta_bic : 100.0 * one.misfit_removed;
    if (!std::isfinite(worth)) continue;
    Series& series = rounds[one.round];
    series.x.push_back(worth);
    series.y.push_back(row_of(panel.y.categories, words(one.effect)));
  }
  for (auto& [round, series] : rounds) {
    series.name = "round " + std::to_string(round);
    series.style = "points";
    series.role = {"estimator", std::max(0, round - 1)};
    panel.series.push_back(std::move(series));
  }
  if (view.adequate()) show_zero(panel);
  if (!panel.series.empty()) figure.frames.push_back({{}, {std::move(panel)}});
  return figure;
}

}  // namespace flexspline::reports
