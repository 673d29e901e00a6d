#include <algorithm>
#include <cmath>

#include "decimated.hpp"
#include "extent.hpp"
#include "figures/study_figures.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

constexpr std::size_t kNumbersInLoopPicker = 160'000;

Extent extent_of(const std::vector<double>& values) {
  Extent extent;
  extent.take(values);
  return extent;
}

/// Keeps the measured loop in view where a simulated one leaves it by far.
void keep_measured_in_view(Panel& panel, const std::string& unit) {
  const Extent measured = extent_of(panel.series.front().y);
  const double span = measured.upper - measured.lower;
  if (!(span > 0.0)) return;
  const auto [lower, upper] = widened(measured.lower, measured.upper, 0.6);
  double largest = 0.0;
  for (const Series& series : panel.series) {
    const Extent all = extent_of(series.y);
    if (all.lower < lower || all.upper > upper) {
      largest = std::max(largest, all.reach());
    }
  }
  if (largest == 0.0) return;
  panel.y.range = {lower, upper};
  panel.title += " (cut: a simulated loop reaches " + digits(largest, 2) + " " + unit + ")";
}

Panel loop_panel(const StudyView& view, const Input& input, const InputRecording& recording,
                 std::size_t points) {
  Panel panel;
  panel.x.label = input.units.motion_label();
  panel.y.label = input.units.effort_label();
  Series measured{"measured", "line", {"measured", 0}, recording.motion, recording.effort, {}, {}};
  std::vector<Series> simulated;
  for (const EstimatorView& estimator : view.estimators()) {
    const Case* item = view.find(input, estimator);
    const CaseRecording* fit = item != nullptr ? item->recording(recording.id) : nullptr;
    if (fit == nullptr || fit->simulated.empty()) continue;
    if (simulated.empty()) {
      panel.title = place_of(input, *fit);
      measured.x = fit->motion;
      measured.y = fit->measured;
    }
    simulated.push_back(
        {estimator.id, "line", role_of(estimator), fit->motion, fit->simulated, {}, {}});
  }
  panel.series.push_back(std::move(measured));
  for (Series& series : simulated) panel.series.push_back(std::move(series));
  for (Series& series : panel.series) {
    decimate(series.x, series.y, points);
  }
  keep_measured_in_view(panel, input.units.effort);
  return panel;
}

std::vector<std::string> choice_of(const StudyView& view, const Input& input,
                                   const InputRecording& recording) {
  if (!view.on_grid()) return {input.title, recording.id};
  return {input.title, compact(recording.amplitude, 4) + " " + input.units.motion,
          compact(recording.frequency_hz, 4) + " Hz"};
}

}  // namespace

Role role_of(const EstimatorView& estimator) { return {"estimator", estimator.rank}; }

Figure own_loop_figure(const StudyView& view) {
  Figure figure;
  figure.id = "own-loop";
  figure.title = "The training loop that all estimators share";
  figure.caption =
      "Look for daylight between the lines. Where there is none, this loop does not separate the "
      "estimators "
      "apart: agreement on what was fitted proves nothing.";
  figure.alt =
      "Hysteresis loop, torque (force) over torsion (displacement): measured, and simulated by "
      "every estimator.";
  figure.pickers = {"input"};
  for (const Input& input : view.artefacts().inputs) {
    const std::string id = view.operating_point(input).recording;
    for (const InputRecording& recording : input.recordings) {
      if (recording.id != id || recording.motion.empty()) continue;
      figure.frames.push_back({{input.title}, {loop_panel(view, input, recording, 2000)}});
    }
  }
  return figure;
}

Figure loops_figure(const StudyView& view) {
  Figure figure;
  figure.id = "loops";
  figure.title = "Loop by loop: measured against each estimator";
  figure.caption =
      "Step away from the training loop, in amplitude or in frequency, and watch which line stays "
      "on "
      "the measured one. Ctrl and the wheel zoom, or two fingers; a click in the legend hides a "
      "line.";
  figure.alt = "Hysteresis loops at every amplitude and frequency: measured and simulated.";
  figure.pickers = view.on_grid() ? std::vector<std::string>{"input", "amplitude", "frequency"}
                                  : std::vector<std::string>{"input", "recording"};
  std::size_t loops = 1;
  for (const Input& input : view.artefacts().inputs) loops += view.places(input).size();
  const std::size_t numbers = kNumbersInLoopPicker / (loops * (view.estimators().size() + 2));
  const std::size_t points = std::clamp<std::size_t>(numbers, 120, 2000);
  for (const Input& input : view.artefacts().inputs) {
    for (const InputRecording* recording : view.places(input)) {
      if (recording->motion.empty()) continue;
      figure.frames.push_back(
          {choice_of(view, input, *recording), {loop_panel(view, input, *recording, points)}});
    }
  }
  return figure;
}

}  // namespace flexspline::reports
