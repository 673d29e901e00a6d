#include <algorithm>
#include <cmath>

#include "figures/study_figures.hpp"
#include "flexspline/reports/section.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

/// "(0.7, 1)": amplitude and frequency relative to the operating point.
std::string relative_place(const OperatingPoint& point, const InputRecording& recording) {
  const double amplitude = recording.amplitude / point.amplitude;
  const double frequency = recording.frequency_hz / point.frequency_hz;
  if (!std::isfinite(amplitude) || !std::isfinite(frequency)) return recording.id;
  return "(" + compact(std::round(amplitude * 1000.0) / 1000.0, 3) + ", " +
         compact(std::round(frequency * 1000.0) / 1000.0, 3) + ")";
}

/// Places at which every estimator that ran has a recording; what only one was trained on is no
/// comparison.
std::vector<const InputRecording*> common_places(const StudyView& view, const Input& input) {
  std::vector<const InputRecording*> places = view.places(input);
  for (const EstimatorView& estimator : view.estimators()) {
    const Case* item = view.find(input, estimator);
    if (item == nullptr || item->failed) continue;
    std::erase_if(places,
                  [&](const auto* place) { return view.at_place(*item, *place) == nullptr; });
  }
  return places;
}

Table by_recording(const StudyView& view, const Input& input) {
  const OperatingPoint point = view.operating_point(input);
  Table table{"errors-" + slug(input.id),
              "Error in percent of peak on " + input.title +
                  ", by (amplitude, frequency) relative to the operating point.",
              {{"estimator", "", 3}, {"loops trained on", "", 0}},
              {}};
  const auto places = common_places(view, input);
  for (const InputRecording* place : places) {
    table.columns.push_back(errors_of_signal(relative_place(point, *place)));
  }
  for (const EstimatorView& estimator : view.estimators()) {
    const Case* item = view.find(input, estimator);
    if (item == nullptr || item->failed) continue;
    std::vector<Cell> row{estimator.id, static_cast<double>(item->train.size())};
    for (const InputRecording* place : places) {
      const CaseRecording* fit = view.at_place(*item, *place);
      row.emplace_back(fit != nullptr ? fit->error_percent() : kAbsent);
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// A virtual bench without f and g^-1 as truth: memory that no viscous law describes.
bool is_rate_independent(const Input& input) {
  return input.kind == "bench" && input.truth.empty();
}

/// Slope of ln(half height) along one quantity at fixed other; NaN where there is no such pair.
double exponent(const Input& input, double InputRecording::*along, double InputRecording::*fixed) {
  std::vector<double> slopes;
  for (const InputRecording& a : input.recordings) {
    for (const InputRecording& b : input.recordings) {
      const bool pair = same(a.*fixed, b.*fixed) && a.*along < b.*along;
      if (!pair || !(a.half_height > 0.0) || !(b.half_height > 0.0)) continue;
      slopes.push_back(std::log(b.half_height / a.half_height) / std::log(b.*along / a.*along));
    }
  }
  return median(std::move(slopes));
}

std::string verdict_of(const Input& input) {
  const double amplitude =
      exponent(input, &InputRecording::amplitude, &InputRecording::frequency_hz);
  const double frequency =
      exponent(input, &InputRecording::frequency_hz, &InputRecording::amplitude);
  if (!std::isfinite(amplitude) || !std::isfinite(frequency)) return {};
  const std::string reading =
      std::abs(frequency) < 0.1
          ? ": flat in frequency, so what is lost per cycle is rate-independent, not viscous."
          : ": it depends on frequency, so part of what is lost per cycle is viscous.";
  return input.title + ": the loop's half height goes with amplitude to the power " +
         digits(amplitude, 2) + " and with frequency to the power " + digits(frequency, 2) +
         reading;
}

Figure residual_figure(const Figure& loops) {
  Figure figure;
  figure.id = "residuals";
  figure.title = "Residual: measured minus simulated";
  figure.caption =
      "Noise has no shape. A residual that is a loop of its own, or grows at the ends of the "
      "motion, "
      "is physics that the model does not have.";
  figure.alt = "Residual over torsion for every estimator on the chosen recording.";
  figure.derived_from = loops.id;
  figure.y_label = "measured - simulated";
  return figure;
}

std::optional<Section> draw(const StudyView& view) {
  const auto& inputs = view.artefacts().inputs;
  if (inputs.empty()) return std::nullopt;
  Section section{"left-over-section", "What is left over?", {}};
  Figure heights = half_height_figure(view);
  if (!heights.frames.empty()) {
    for (const Input& input : inputs) {
      const bool telling = is_rate_independent(input) || inputs.size() == 1;
      const std::string verdict = telling ? verdict_of(input) : std::string{};
      if (!verdict.empty()) section.add(Verdict{verdict});
    }
    section.add(std::move(heights));
  }
  if (!view.artefacts().cases.empty()) {
    const Figure loops = loops_figure(view);
    if (!loops.frames.empty()) section.add(residual_figure(loops));
    if (Figure ordered = ordered_residuals_figure(view); !ordered.frames.empty()) {
      section.fold("By time, torsion, velocity, load and order", std::move(ordered));
    }
    for (const Input& input : inputs) {
      if (is_rate_independent(input)) section.add(by_recording(view, input));
    }
    for (const Input& input : inputs) {
      if (is_rate_independent(input)) continue;
      section.fold("Error by recording on the other inputs", by_recording(view, input));
    }
  }
  if (section.blocks.empty()) return std::nullopt;
  return section;
}

}  // namespace

SectionRow describe_left_over() { return {50, draw}; }

}  // namespace flexspline::reports
