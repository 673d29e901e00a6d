#include <algorithm>

#include "decimated.hpp"
#include "extent.hpp"
#include "figures/diagnosis_figures.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

constexpr std::size_t kPoints = 4000;

/// Of the recordings kept back, the one with the largest mismatch; else of all.
const ShownSeries* shown_series(const DiagnosisView& view) {
  const auto ordered = worst_first(view);
  const auto kept = std::find_if(ordered.begin(), ordered.end(), [](const ShownSeries* one) {
    return !one->trained && !one->measured.empty();
  });
  if (kept != ordered.end()) return *kept;
  return ordered.empty() || ordered.front()->measured.empty() ? nullptr : ordered.front();
}

Panel panel_of(const DiagnosisView& view, const ShownSeries& series, const std::string& title,
               const std::string& name, int rank, const std::vector<double>& model) {
  Panel panel;
  panel.title = title;
  panel.x.label = view.units.motion_label();
  panel.y.label = view.units.effort_label();
  panel.series.push_back(
      {"measured", "line", {"measured", 0}, series.motion, series.measured, {}, {}});
  panel.series.push_back({name, "line", {"estimator", rank}, series.motion, model, {}, {}});
  for (Series& one : panel.series) decimate(one.x, one.y, kPoints);
  return panel;
}

/// Both models are judged on equal axes.
void share_axes(std::vector<Panel>& panels) {
  Extent motion;
  Extent effort;
  for (const Panel& panel : panels) {
    for (const Series& series : panel.series) {
      motion.take(series.x);
      effort.take(series.y);
    }
  }
  for (Panel& panel : panels) {
    panel.x.range = widened(motion.lower, motion.upper, 0.04);
    panel.y.range = widened(effort.lower, effort.upper, 0.04);
  }
}

}  // namespace

Figure headline_figure(const DiagnosisView& view) {
  Figure figure;
  figure.id = "headline";
  const ShownSeries* series = shown_series(view);
  if (series == nullptr) return figure;
  figure.title =
      (series->trained ? "One recording: " : "A recording held out: ") + series->recording;
  figure.caption = series->has_after()
                       ? "Left without, right with the missing physics. The wide line is measured; "
                         "what it shows beside the thin one is what the model lacks."
                       : "The wide line is measured; what it shows beside the thin one is what the "
                         "model lacks.";
  figure.alt = "Hysteresis loop measured and modelled, without and with the missing physics.";
  Frame frame;
  frame.panels.push_back(
      panel_of(view, *series, series->has_after() ? "without" : "", "baseline", 0, series->before));
  if (series->has_after()) {
    frame.panels.push_back(
        panel_of(view, *series, "with", "with the missing physics", 1, series->after));
  }
  share_axes(frame.panels);
  figure.frames.push_back(std::move(frame));
  return figure;
}

}  // namespace flexspline::reports
