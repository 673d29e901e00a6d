#include <algorithm>
#include <cmath>
#include <set>

#include "figures/study_figures.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

struct Grid {
  std::vector<double> amplitudes;
  std::vector<double> frequencies;

  int row(double amplitude) const { return index(amplitudes, amplitude); }
  int column(double frequency) const { return index(frequencies, frequency); }

 private:
  static int index(const std::vector<double>& values, double value) {
    return static_cast<int>(std::lower_bound(values.begin(), values.end(), value) - values.begin());
  }
};

Grid grid_of(const Input& input) {
  std::set<double> amplitudes, frequencies;
  for (const InputRecording& recording : input.recordings) {
    amplitudes.insert(recording.amplitude);
    frequencies.insert(recording.frequency_hz);
  }
  return {{amplitudes.begin(), amplitudes.end()}, {frequencies.begin(), frequencies.end()}};
}

std::vector<std::string> labels(const std::vector<double>& values) {
  std::vector<std::string> labels;
  for (const double value : values) labels.push_back(compact(value, 3));
  return labels;
}

/// A loop that was recorded twice counts as trained on where its twin was.
std::string note_of(const Input& input, const Case& item, const CaseRecording& recording) {
  for (const InputRecording& one : input.recordings) {
    const bool here = recording.id == one.id || (same(one.amplitude, recording.amplitude) &&
                                                 same(one.frequency_hz, recording.frequency_hz));
    const bool trained =
        std::find(item.train.begin(), item.train.end(), one.id) != item.train.end();
    if (here && trained) return "trained";
  }
  return recording.outside_domain ? "outside" : "";
}

Panel grid_panel(const StudyView& view, const Input& input, const Case& item,
                 const std::string& title) {
  const Grid grid = grid_of(input);
  Panel panel;
  panel.title = title;
  panel.x = {"frequency / Hz", false, labels(grid.frequencies), {}};
  panel.y = {"amplitude / " + input.units.motion, false, labels(grid.amplitudes), {}};
  for (const InputRecording* place : view.places(input)) {
    const CaseRecording* fit = view.at_place(item, *place);
    if (fit == nullptr) continue;
    panel.cells.push_back({grid.column(place->frequency_hz), grid.row(place->amplitude),
                           fit->error_percent(), note_of(input, item, *fit)});
  }
  return panel;
}

Panel list_panel(const StudyView& view, const Input& input) {
  Panel panel;
  panel.x.label = "estimator";
  panel.y.label = "recording";
  for (const InputRecording& recording : input.recordings) {
    panel.y.categories.push_back(recording.id);
  }
  for (const EstimatorView& estimator : view.estimators()) {
    panel.x.categories.push_back(estimator.id);
    const Case* item = view.find(input, estimator);
    if (item == nullptr || item->failed) continue;
    for (std::size_t row = 0; row < input.recordings.size(); ++row) {
      const CaseRecording* fit = item->recording(input.recordings[row].id);
      if (fit == nullptr) continue;
      panel.cells.push_back({estimator.rank, static_cast<int>(row), fit->error_percent(),
                             note_of(input, *item, *fit)});
    }
  }
  return panel;
}

std::vector<Panel> panels_of(const StudyView& view, const Input& input) {
  if (!view.on_grid()) return {list_panel(view, input)};
  std::vector<Panel> panels;
  for (const EstimatorView& estimator : view.estimators()) {
    const Case* item = view.find(input, estimator);
    if (item == nullptr) continue;
    const std::string title = item->failed ? estimator.id + " (failed)" : estimator.id;
    panels.push_back(grid_panel(view, input, *item, title));
  }
  return panels;
}

/// One scale for all panels and frames, in whole decades from 0.01 % to 1000 % at most.
std::pair<double, double> common_scale(const Figure& figure) {
  double lower = HUGE_VAL, upper = 0.0;
  for (const Frame& frame : figure.frames) {
    for (const Panel& panel : frame.panels) {
      for (const HeatCell& cell : panel.cells) {
        if (!(cell.value > 0.0) || !std::isfinite(cell.value)) continue;
        lower = std::min(lower, cell.value);
        upper = std::max(upper, cell.value);
      }
    }
  }
  if (upper == 0.0) return {0.1, 100.0};
  const double first = std::clamp(std::floor(std::log10(lower)), -2.0, 2.0);
  const double last = std::clamp(std::ceil(std::log10(upper)), first + 1.0, 3.0);
  return {std::pow(10.0, first), std::pow(10.0, std::max(last, first + 1.0))};
}

}  // namespace

Figure error_map_figure(const StudyView& view) {
  Figure figure;
  figure.id = "error-maps";
  figure.kind = "heatmap";
  figure.title = "Error of the simulated torque or force, in percent of that recording's peak";
  figure.caption =
      "Dark is good, bright is bad, on one logarithmic scale for all maps. T marks what the "
      "estimator was trained on; * lies outside its domain of validity. A model that has found the "
      "physics is dark everywhere, not only at its T.";
  figure.alt = "Heat maps of the error over amplitude and frequency, one for each estimator.";
  figure.pickers = {"input"};
  for (const Input& input : view.artefacts().inputs) {
    auto panels = panels_of(view, input);
    if (!panels.empty()) figure.frames.push_back({{input.title}, std::move(panels)});
  }
  figure.scale = common_scale(figure);
  return figure;
}

}  // namespace flexspline::reports
