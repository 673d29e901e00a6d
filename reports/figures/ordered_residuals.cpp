#include <cmath>
#include <numbers>

#include "figures/diagnosis_figures.hpp"
#include "figures/residual_panels.hpp"
#include "figures/study_figures.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

constexpr const char* kCaption =
    "Means over up to twenty stretches of each coordinate, and the amplitude at each order. Noise "
    "averages to zero everywhere; a line that leaves zero, or an order that stands out, says which "
    "coordinate the missing physics follows.";

std::vector<double> less(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> difference;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    difference.push_back(a[i] - b[i]);
  }
  return difference;
}

std::vector<double> rate_of(const std::vector<double>& time, const std::vector<double>& motion) {
  std::vector<double> rate(motion.size(), kAbsent);
  for (std::size_t i = 1; i + 1 < std::min(time.size(), motion.size()); ++i) {
    rate[i] = (motion[i + 1] - motion[i - 1]) / (time[i + 1] - time[i - 1]);
  }
  return rate;
}

std::vector<double> phase_of(const std::vector<double>& time, double frequency_hz) {
  std::vector<double> phase;
  if (!std::isfinite(frequency_hz)) return phase;
  for (const double t : time) phase.push_back(2.0 * std::numbers::pi * frequency_hz * t);
  return phase;
}

std::vector<Panel> panels_at(const StudyView& view, const Input& input,
                             const InputRecording& recording) {
  Coordinates at;
  at.motion = recording.motion;
  at.effort = recording.effort;
  if (recording.time.size() == recording.motion.size()) {
    at.time = recording.time;
    at.rate = rate_of(recording.time, recording.motion);
    at.phase = phase_of(recording.time, recording.frequency_hz);
  }
  at.turn = "of the excitation";
  at.units = input.units;
  std::vector<Remainder> left;
  for (const EstimatorView& estimator : view.estimators()) {
    const Case* item = view.find(input, estimator);
    const CaseRecording* fit = item != nullptr ? item->recording(recording.id) : nullptr;
    if (fit == nullptr || fit->simulated.size() != recording.motion.size()) continue;
    left.push_back({estimator.id, role_of(estimator), less(fit->measured, fit->simulated)});
  }
  return left.empty() ? std::vector<Panel>{} : residual_panels(at, left, false);
}

}  // namespace

Figure ordered_residuals_figure(const StudyView& view) {
  Figure figure;
  figure.id = "ordered-residuals";
  figure.title = "Residual over time, torsion, velocity, load and order";
  figure.caption = kCaption;
  figure.alt = "Means of the residual over five coordinates, by estimator.";
  figure.pickers = {"input", "recording"};
  for (const Input& input : view.artefacts().inputs) {
    for (const InputRecording* recording : view.places(input)) {
      auto panels = panels_at(view, input, *recording);
      if (!panels.empty()) {
        figure.frames.push_back({{input.title, recording->id}, std::move(panels)});
      }
    }
  }
  return figure;
}

Figure ordered_residuals_figure(const DiagnosisView& view) {
  Figure figure;
  figure.id = "ordered-residuals";
  figure.title = "Residual over time, torsion, velocity, load and order";
  figure.caption = std::string(kCaption) + " Shaded: twice the standard error of the mean.";
  figure.alt = "Means of the residual over five coordinates, before and after.";
  figure.pickers = pickers_of(view);
  for (const ShownSeries* series : worst_first(view)) {
    Coordinates at{series->time, series->motion, series->rate, series->measured,
                   {},           "of the motor", view.units};
    for (const double angle : series->motor_angle) {
      at.phase.push_back(angle * std::numbers::pi / 180.0);
    }
    std::vector<Remainder> left = {
        {"baseline", {"estimator", 0}, less(series->measured, series->before)}};
    if (series->has_after()) {
      left.push_back(
          {"with the missing physics", {"estimator", 1}, less(series->measured, series->after)});
    }
    auto panels = residual_panels(at, left, true);
    if (!panels.empty()) figure.frames.push_back({choice_of(view, *series), std::move(panels)});
  }
  return figure;
}

}  // namespace flexspline::reports
