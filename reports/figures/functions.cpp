#include <algorithm>
#include <array>
#include <cmath>

#include "figures/study_figures.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

struct Extent {
  double lower = HUGE_VAL;
  double upper = -HUGE_VAL;

  void take(double value) {
    if (!std::isfinite(value)) return;
    lower = std::min(lower, value);
    upper = std::max(upper, value);
  }
};

/// A band that is within its domain of validity at this argument, or has none.
bool valid_at(const Band& band, double argument) {
  return !(argument < band.valid_from) && !(argument > band.valid_to);
}

void add_estimator(Panel& panel, Extent& extent, const EstimatorView& estimator, const Band& band) {
  const Role role = role_of(estimator);
  if (band.lower.size() == band.argument.size() && band.upper.size() == band.argument.size()) {
    panel.series.push_back(
        {estimator.id + ", 95 %", "band", role, band.argument, band.value, band.lower, band.upper});
  }
  panel.series.push_back({estimator.id, "line", role, band.argument, band.value, {}, {}});
  for (std::size_t i = 0; i < band.argument.size() && i < band.value.size(); ++i) {
    if (valid_at(band, band.argument[i])) extent.take(band.value[i]);
  }
}

void add_marks(Panel& panel, const Band& band, const std::string& estimator) {
  for (const double end : {band.valid_from, band.valid_to}) {
    if (!std::isfinite(end)) continue;
    const auto known = std::find_if(panel.marks.begin(), panel.marks.end(), [&](const Mark& mark) {
      return std::abs(mark.at - end) < 0.02 * std::abs(end);
    });
    if (known == panel.marks.end()) {
      panel.marks.push_back({rounded(end, 4), "domain ends: " + estimator});
    } else {
      known->label += ", " + estimator;
    }
  }
}

std::string argument_label(const std::string& function, const std::string& unit) {
  return (function == "g_inverse" ? "rate of motion / " : "motion / ") + unit;
}

Panel function_panel(const StudyView& view, const Input& input, const std::string& function) {
  Panel panel;
  panel.title = function_label(function);
  Extent extent;
  const auto truth = input.truth.find(function);
  if (truth != input.truth.end() && !truth->second.argument.empty()) {
    panel.series.push_back(
        {"truth", "line", {"truth", 0}, truth->second.argument, truth->second.value, {}, {}});
    for (const double value : truth->second.value) extent.take(value);
  }
  for (const EstimatorView& estimator : view.estimators()) {
    const Case* item = view.find(input, estimator);
    const Band* band = item != nullptr ? item->band(function) : nullptr;
    if (band == nullptr || band->argument.empty()) continue;
    panel.x.label = argument_label(function, band->unit_argument);
    panel.y.label = function_label(function) + (function == "h" ? "" : " / " + band->unit_value);
    add_estimator(panel, extent, estimator, *band);
    add_marks(panel, *band, estimator.id);
  }
  const double margin = 0.25 * (extent.upper - extent.lower);
  if (margin > 0.0) {
    panel.y.range = {rounded(extent.lower - margin, 2), rounded(extent.upper + margin, 2)};
  }
  return panel;
}

bool estimated(const Panel& panel) {
  return std::any_of(panel.series.begin(), panel.series.end(),
                     [](const Series& series) { return series.role.name == "estimator"; });
}

}  // namespace

std::string function_label(const std::string& function) {
  return function == "g_inverse" ? "g⁻¹" : function;
}

Figure function_figure(const StudyView& view) {
  Figure figure;
  figure.id = "functions";
  figure.title = "f, g⁻¹ and, where it can be known, h";
  figure.caption =
      "Shaded: 95 % bands. Vertical lines: where the recordings an estimator saw end. Beyond them "
      "a "
      "polynomial turns round and leaves the picture; a band says nothing there.";
  figure.alt =
      "Estimated functions with confidence bands, the truth where known, and the ends of "
      "the domains of validity.";
  figure.pickers = {"input"};
  for (const Input& input : view.artefacts().inputs) {
    Frame frame{{input.title}, {}};
    for (const char* function : {"f", "g_inverse", "h"}) {
      Panel panel = function_panel(view, input, function);
      if (estimated(panel)) frame.panels.push_back(std::move(panel));
    }
    if (!frame.panels.empty()) figure.frames.push_back(std::move(frame));
  }
  return figure;
}

}  // namespace flexspline::reports
