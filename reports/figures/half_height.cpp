#include <algorithm>
#include <cmath>
#include <map>

#include "figures/study_figures.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

using Number = double InputRecording::*;

/// Half height over `along`, one line for each value of `each`.
Panel panel_over(const StudyView& view, const Input& input, Number along,
                 const std::string& along_label, Number each, const std::string& each_name,
                 const std::string& each_unit) {
  std::map<double, std::map<double, double>> lines;
  for (const InputRecording* recording : view.places(input)) {
    if (!std::isfinite(recording->half_height) || !std::isfinite(recording->*along)) continue;
    if (!std::isfinite(recording->*each)) continue;
    lines[recording->*each][recording->*along] = recording->half_height;
  }
  std::erase_if(lines, [](const auto& line) { return line.second.size() < 2; });
  Panel panel;
  panel.x.label = along_label;
  panel.y.label = "half height / " + input.units.effort;
  int rank = 0;
  for (const auto& [value, points] : lines) {
    Series series{each_name + " " + compact(value, 3) + " " + each_unit,
                  "line",
                  {"plain", rank++},
                  {},
                  {},
                  {},
                  {}};
    for (const auto& [x, y] : points) {
      series.x.push_back(x);
      series.y.push_back(y);
    }
    panel.series.push_back(std::move(series));
  }
  return panel;
}

bool has_a_line(const Panel& panel) { return !panel.series.empty(); }

}  // namespace

Figure half_height_figure(const StudyView& view) {
  Figure figure;
  figure.id = "half-height";
  figure.title = "Half height of the measured loop at zero torsion";
  figure.caption =
      "Viscous friction grows with amplitude and with frequency alike. A loop whose height grows "
      "with amplitude but stays flat in frequency is rate-independent: presliding, not viscosity.";
  figure.alt = "Half height of the loop against amplitude, and against frequency.";
  figure.pickers = {"input"};
  for (const Input& input : view.artefacts().inputs) {
    const std::string& unit = input.units.motion;
    Panel amplitude = panel_over(view, input, &InputRecording::amplitude, "amplitude / " + unit,
                                 &InputRecording::frequency_hz, "at", "Hz");
    Panel frequency = panel_over(view, input, &InputRecording::frequency_hz, "frequency / Hz",
                                 &InputRecording::amplitude, "at", unit);
    amplitude.title = "against amplitude";
    frequency.title = "against frequency";
    frequency.x.log = true;
    Frame frame{{input.title}, {}};
    if (has_a_line(amplitude)) frame.panels.push_back(std::move(amplitude));
    if (has_a_line(frequency)) frame.panels.push_back(std::move(frequency));
    if (!frame.panels.empty()) figure.frames.push_back(std::move(frame));
  }
  return figure;
}

}  // namespace flexspline::reports
