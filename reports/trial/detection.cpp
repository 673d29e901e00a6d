#include <cmath>

#include "figures/trial_figures.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

Table bins_table(const char* id, const char* caption, const std::vector<ShownDetectionBin>& bins) {
  Table table{id,
              caption,
              {{"from", "%", 2},
               {"to", "%", 2},
               {"cases", "", 0},
               {"detected", "", 0},
               {"named first", "", 0},
               {"named exactly", "", 0}},
              {}};
  for (const ShownDetectionBin& bin : bins) {
    table.rows.push_back(
        {100.0 * bin.from, 100.0 * bin.to, bin.cases, bin.detected, bin.first_right, bin.exact});
  }
  return table;
}

Table effects_table(const TrialView& view) {
  Table table{"trial-by-effect",
              "Single effects, rig by rig. Located: the right coordinate is among the first three "
              "mismatches.",
              {{"rig", "", 3},
               {"hidden", "", 3},
               {"cases", "", 0},
               {"named first", "", 0},
               {"named exactly", "", 0},
               {"located", "", 0},
               {"failed", "", 0},
               {"hold-out over noise", "", 3}},
              {}};
  for (const ShownEffectScore& one : view.by_effect) {
    table.rows.push_back({one.rig, words(one.effect), one.cases, one.first_right, one.exact,
                          one.coordinate_right, one.failed, one.after_over_noise});
  }
  return table;
}

std::optional<Section> draw(const TrialView& view) {
  if (view.by_size.empty() && view.by_effect.empty()) return std::nullopt;
  Section section{
      "detection-section", "How large must an effect be, and which ones are missed?", {}};
  if (Figure figure = detection_figure(view); !figure.frames.empty()) {
    section.add(std::move(figure));
  }
  if (!view.by_size.empty()) {
    section.add(bins_table("trial-by-size", "Single effects by size, in percent of peak torque.",
                           view.by_size));
  }
  if (!view.by_trace.empty()) {
    section.add(bins_table("trial-by-trace",
                           "Single effects by their trace, what the fitted baseline leaves of "
                           "them, in percent of peak torque.",
                           view.by_trace));
  }
  if (!view.by_effect.empty()) section.add(effects_table(view));
  return section;
}

}  // namespace

TrialSectionRow describe_detection() { return {20, draw}; }

}  // namespace flexspline::reports
