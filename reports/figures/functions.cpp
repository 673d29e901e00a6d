#include <algorithm>
#include <array>
#include <cmath>

#include "extent.hpp"
#include "figures/study_figures.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

/// A band that is within its domain of validity at this argument, or has none.
bool valid_at(const Band& band, double argument) {
  return !(argument < band.valid_from) && !(argument > band.valid_to);
}

constexpr std::size_t kBandPoints = 81;

Band thinned_band(Band band) {
  for (auto* series : {&band.argument, &band.value, &band.lower, &band.upper}) {
    *series = thinned(*series, kBandPoints);
  }
  return band;
}

/// What has to be in view: the values within the domains, and bands as far as they do not dwarf
/// them.
struct View {
  Extent values, bands;

  std::pair<double, double> range() const {
    const double span = std::max(values.upper - values.lower, 0.02 * std::abs(values.upper));
    return widened(std::clamp(bands.lower, values.lower - span, values.lower),
                   std::clamp(bands.upper, values.upper, values.upper + span), 0.3);
  }
};

void add_estimator(Panel& panel, View& extent, const EstimatorView& estimator, const Band& whole) {
  const Role role = role_of(estimator);
  const Band band = thinned_band(whole);
  if (band.lower.size() == band.argument.size() && band.upper.size() == band.argument.size()) {
    panel.series.push_back(
        {estimator.id + ", 95 %", "band", role, band.argument, band.value, band.lower, band.upper});
  }
  panel.series.push_back({estimator.id, "line", role, band.argument, band.value, {}, {}});
  for (std::size_t i = 0; i < band.argument.size() && i < band.value.size(); ++i) {
    if (!valid_at(band, band.argument[i])) continue;
    extent.values.take(band.value[i]);
    if (i < band.lower.size()) extent.bands.take(band.lower[i]);
    if (i < band.upper.size()) extent.bands.take(band.upper[i]);
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

std::string argument_label(const std::string& function, const ShownUnits& units,
                           const std::string& unit) {
  return (function == "g_inverse" ? units.rate_name() : units.motion_name()) + " / " + unit;
}

Panel function_panel(const StudyView& view, const Input& input, const std::string& function) {
  Panel panel;
  panel.title = function_label(function);
  View extent;
  const auto truth = input.truth.find(function);
  if (truth != input.truth.end() && !truth->second.argument.empty()) {
    panel.series.push_back(
        {"truth", "line", {"truth", 0}, truth->second.argument, truth->second.value, {}, {}});
    for (const double value : truth->second.value) extent.values.take(value);
  }
  for (const EstimatorView& estimator : view.estimators()) {
    const Case* item = view.find(input, estimator);
    const Band* band = item != nullptr ? item->band(function) : nullptr;
    if (band == nullptr || band->argument.empty()) continue;
    panel.x.label = argument_label(function, input.units, band->unit_argument);
    panel.y.label = function_label(function) + (function == "h" ? "" : " / " + band->unit_value);
    add_estimator(panel, extent, estimator, *band);
    add_marks(panel, *band, estimator.id);
  }
  if (!extent.values.empty()) panel.y.range = extent.range();
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
