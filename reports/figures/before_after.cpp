#include <algorithm>
#include <cmath>

#include "figures/diagnosis_figures.hpp"
#include "flexspline/core/units.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

double rms_of(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    const double difference = a[i] - b[i];
    if (!std::isfinite(difference)) continue;
    sum += difference * difference;
    ++count;
  }
  return count == 0 ? kAbsent : std::sqrt(sum / static_cast<double>(count));
}

std::string label_of(const DiagnosisView& view, const ShownSeries& series) {
  std::string label = series.recording;
  if (view.has_equations()) label += ", " + series.equation;
  return label + (series.trained ? "" : " (held out)");
}

double in_shown_effort(const DiagnosisView& view, double rmse) {
  const auto from = find_unit(view.rmse_unit);
  const auto to = find_unit(view.units.effort);
  return from && to ? from_si(*to, to_si(*from, rmse)) : kAbsent;
}

}  // namespace

Figure before_after_figure(const DiagnosisView& view) {
  Figure figure;
  figure.id = "before-after";
  figure.kind = "scatter";
  figure.title = "Every recording, before and after";
  figure.caption =
      "Root mean square of measured minus modelled torque or force over the samples drawn above. A "
      "cause "
      "that is real moves the symbols to the left on held-out recordings too, as far as the noise "
      "and no further.";
  figure.alt = "Misfit of every recording without and with the missing physics.";
  Panel panel;
  panel.x.label = "residual rms / " + view.units.effort;
  panel.y.label = "recording";
  Series before{"baseline", "points", {"estimator", 0}, {}, {}, {}, {}};
  Series after{"with the missing physics", "points", {"estimator", 1}, {}, {}, {}, {}};
  for (const ShownSeries& one : view.series) {
    const auto row = static_cast<double>(panel.y.categories.size());
    panel.y.categories.push_back(label_of(view, one));
    before.x.push_back(rms_of(one.measured, one.before));
    before.y.push_back(row);
    if (!one.has_after()) continue;
    after.x.push_back(rms_of(one.measured, one.after));
    after.y.push_back(row);
  }
  if (before.x.empty()) return figure;
  const auto largest = [](const Series& series) {
    return series.x.empty() ? 0.0 : *std::max_element(series.x.begin(), series.x.end());
  };
  panel.x.range = {0.0, rounded(1.05 * std::max(largest(before), largest(after)), 2)};
  // The floor is that of the torque at the output: a motor's equation has one of its own.
  const double noise = in_shown_effort(view, view.noise_floor);
  if (!view.has_equations() && noise < panel.x.range->second) {
    panel.marks.push_back({rounded(noise, 3), "noise floor / " + view.units.effort});
  }
  panel.series.push_back(std::move(before));
  if (!after.x.empty()) panel.series.push_back(std::move(after));
  figure.frames.push_back({{}, {std::move(panel)}});
  return figure;
}

}  // namespace flexspline::reports
