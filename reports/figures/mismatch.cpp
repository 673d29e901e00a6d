#include <algorithm>
#include <cmath>

#include "decimated.hpp"
#include "figures/diagnosis_figures.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

constexpr std::size_t kNumbersInPicture = 150'000;
constexpr std::size_t kNumbersOfAPoint = 8;  ///< two panels, their axes and three lines each

/// Several mismatches may share their place: each stretch of time once.
std::vector<Span> merged(std::vector<Span> spans) {
  std::sort(spans.begin(), spans.end(),
            [](const Span& a, const Span& b) { return a.from < b.from; });
  std::vector<Span> apart;
  for (const Span& span : spans) {
    if (apart.empty() || span.from > apart.back().to) {
      apart.push_back(span);
    } else {
      apart.back().to = std::max(apart.back().to, span.to);
    }
  }
  return apart;
}

std::vector<Span> spans_of(const DiagnosisView& view, const ShownSeries& series) {
  std::vector<Span> spans;
  for (const ShownMismatch& one : view.mismatch) {
    const bool here = one.recording == series.recording &&
                      (one.equation.empty() || one.equation == series.equation);
    if (here && std::isfinite(one.from_s) && std::isfinite(one.to_s)) {
      spans.push_back({one.from_s, one.to_s});
    }
  }
  return merged(std::move(spans));
}

/// What was measured inside the spans, nothing elsewhere.
std::vector<double> inside(const ShownSeries& series, const std::vector<Span>& spans) {
  std::vector<double> values(series.measured.size(), kAbsent);
  for (std::size_t i = 0; i < std::min(values.size(), series.time.size()); ++i) {
    const double t = series.time[i];
    const bool covered = std::any_of(spans.begin(), spans.end(), [t](const Span& span) {
      return span.from <= t && t <= span.to;
    });
    if (covered) values[i] = series.measured[i];
  }
  return values;
}

Panel panel_of(const ShownSeries& series, const std::vector<double>& x, const std::string& title,
               const std::string& x_label, const ShownUnits& units) {
  Panel panel;
  panel.title = title;
  panel.x.label = x_label;
  panel.y.label = units.effort_label();
  panel.series.push_back({"measured", "line", {"measured", 0}, x, series.measured, {}, {}});
  panel.series.push_back({"baseline", "line", {"estimator", 0}, x, series.before, {}, {}});
  if (series.has_after()) {
    panel.series.push_back(
        {"with the missing physics", "line", {"estimator", 1}, x, series.after, {}, {}});
  }
  return panel;
}

std::vector<double> left_by(const ShownSeries& series, const std::vector<double>& model) {
  std::vector<double> residual(std::min(model.size(), series.measured.size()));
  for (std::size_t i = 0; i < residual.size(); ++i) residual[i] = series.measured[i] - model[i];
  return residual;
}

/// The page draws residuals from the same points, so that all lines keep those that any needs.
ShownSeries lightened(ShownSeries series, std::size_t points) {
  const std::vector<double> before = left_by(series, series.before);
  const std::vector<double> after = left_by(series, series.after);
  std::vector<DrawnCurve> curves;
  for (const auto* y : {&series.measured, &series.before, &series.after}) {
    curves.push_back({&series.motion, y});
  }
  for (const std::vector<double>* y :
       std::initializer_list<const std::vector<double>*>{&series.measured, &before, &after}) {
    curves.push_back({&series.time, y});
  }
  const auto keep = seen_points(curves, points);
  for (auto* values : {&series.time, &series.motion, &series.rate, &series.measured, &series.before,
                       &series.after}) {
    keep_points(*values, keep);
  }
  return series;
}

std::vector<Panel> panels_of(const DiagnosisView& view, const ShownSeries& series) {
  const std::vector<Span> spans = spans_of(view, series);
  std::vector<Panel> panels;
  panels.push_back(panel_of(series, series.motion, "over the " + view.units.motion_name(),
                            view.units.motion_label(), view.units));
  panels.push_back(panel_of(series, series.time, "along time", "time / s", view.units));
  if (spans.empty()) return panels;
  panels.back().spans = spans;
  panels.front().series.push_back(
      {"where it differs", "line", {"highlight", 0}, series.motion, inside(series, spans), {}, {}});
  return panels;
}

std::size_t points_of(const DiagnosisView& view) {
  const std::size_t lines = std::max<std::size_t>(1, view.series.size());
  return std::clamp<std::size_t>(kNumbersInPicture / (kNumbersOfAPoint * lines), 120, 2000);
}

/// Why lines have gaps, where one has.
std::string on_gaps(const DiagnosisView& view) {
  return std::ranges::all_of(view.series, &ShownSeries::judged_everywhere)
             ? ""
             : " A modelled line breaks where the model is not judged.";
}

std::string caption_of(const DiagnosisView& view) {
  std::string text = "The wide line is measured, the solid one the baseline. ";
  text += view.mismatch.empty()
              ? "It stays within the noise; pick another recording to see that it does so "
                "everywhere."
              : "Yellow marks where they part most, on the loop and along time.";
  if (view.has_additions()) {
    text +=
        " Look whether the dashed line, with the missing physics, stays on the measured one "
        "there.";
  }
  return text + on_gaps(view) +
         " Ctrl and the wheel zoom, or two fingers; a click in the legend hides a line.";
}

}  // namespace

std::vector<const ShownSeries*> worst_first(const DiagnosisView& view) {
  std::vector<const ShownSeries*> ordered;
  for (const ShownSeries& one : view.series) ordered.push_back(&one);
  if (view.mismatch.empty()) return ordered;
  const ShownMismatch& worst = view.mismatch.front();
  std::stable_partition(ordered.begin(), ordered.end(), [&](const ShownSeries* one) {
    return one->recording == worst.recording &&
           (worst.equation.empty() || one->equation == worst.equation);
  });
  return ordered;
}

std::vector<std::string> choice_of(const DiagnosisView& view, const ShownSeries& series) {
  std::vector<std::string> choice{series.recording + (series.trained ? "" : " (held out)")};
  if (view.has_equations()) choice.push_back(series.equation);
  return choice;
}

std::vector<std::string> pickers_of(const DiagnosisView& view) {
  if (view.has_equations()) return {"recording", "equation"};
  return {"recording"};
}

Figure mismatch_figure(const DiagnosisView& view) {
  Figure figure;
  figure.id = "mismatch";
  figure.title = view.has_additions()
                     ? "Measured, and modelled without and with the missing physics"
                     : "Measured, and modelled by the baseline";
  figure.caption = caption_of(view);
  figure.alt =
      "Torque (force) over torsion (displacement) and over time: measured, baseline, and model "
      "with the causes.";
  figure.pickers = pickers_of(view);
  const std::size_t points = points_of(view);
  for (const ShownSeries* one : worst_first(view)) {
    if (one->measured.empty()) continue;
    figure.frames.push_back({choice_of(view, *one), panels_of(view, lightened(*one, points))});
  }
  return figure;
}

Figure remainder_figure(const DiagnosisView& view) {
  Figure figure;
  figure.id = "remainder";
  figure.title = view.adequate() ? "Residual: measured minus modelled"
                                 : "Signature of the mismatch: measured minus modelled";
  figure.caption = "Noise has no shape. Look for one in the solid line, over the " +
                   view.units.motion_name() + " or at certain times";
  figure.caption += view.has_additions() ? ", and whether the dashed line has lost it." : ".";
  figure.caption += on_gaps(view);
  figure.alt = "Residual over torsion (displacement) and over time, before and after.";
  figure.derived_from = "mismatch";
  figure.y_label = "measured minus modelled";
  return figure;
}

Figure over_velocity_figure(const DiagnosisView& view) {
  Figure figure;
  figure.id = "over-velocity";
  figure.title = "Residual over velocity";
  figure.caption =
      "This mismatch depends on the velocity. Look how the circles bend away from zero as "
      "speed grows or falls, and whether the diamonds do not.";
  figure.alt = "Residual over velocity, before and after.";
  figure.pickers = pickers_of(view);
  if (view.mismatch.empty() || view.mismatch.front().coordinate != "velocity") return figure;
  const auto ordered = worst_first(view);
  if (ordered.empty() || ordered.front()->rate.empty()) return figure;
  const ShownSeries series = lightened(*ordered.front(), 400);
  Panel panel =
      panel_of(series, series.rate, series.recording, "velocity / " + view.units.rate, view.units);
  panel.y.label = "measured minus modelled / " + view.units.effort;
  panel.series.erase(panel.series.begin());
  for (Series& line : panel.series) {
    line.style = "points";
    for (std::size_t i = 0; i < std::min(line.y.size(), series.measured.size()); ++i) {
      line.y[i] = series.measured[i] - line.y[i];
    }
  }
  figure.frames.push_back({choice_of(view, series), {std::move(panel)}});
  return figure;
}

}  // namespace flexspline::reports
