#include <algorithm>
#include <cmath>

#include "extent.hpp"
#include "figures/study_figures.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

template <class ErrorOf>
Panel overview_panel(const StudyView& view, const std::string& title, ErrorOf error_of) {
  Panel panel;
  panel.title = title;
  panel.x.label = "error / %";
  panel.x.log = true;
  for (const Input& input : view.artefacts().inputs) panel.y.categories.push_back(input.id);
  for (const EstimatorView& estimator : view.estimators()) {
    Series series{estimator.id, "points", role_of(estimator), {}, {}, {}, {}};
    double row = 0.0;
    for (const Input& input : view.artefacts().inputs) {
      const double error = error_of(input, estimator);
      if (error > 0.0 && std::isfinite(error)) {
        series.x.push_back(error);
        series.y.push_back(row);
      }
      row += 1.0;
    }
    if (!series.x.empty()) panel.series.push_back(std::move(series));
  }
  return panel;
}

Panel function_panel(const StudyView& view, const std::string& function) {
  return overview_panel(
      view, function_label(function), [&](const Input& input, const EstimatorView& estimator) {
        const Case* item = view.find(input, estimator);
        if (item == nullptr) return kAbsent;
        const auto found = item->function_errors_percent.find(function);
        return found == item->function_errors_percent.end() ? kAbsent : found->second;
      });
}

Panel torque_panel(const StudyView& view, const std::string& title, Elsewhere elsewhere) {
  return overview_panel(view, title, [&](const Input& input, const EstimatorView& estimator) {
    return view.worst(input, estimator, elsewhere).percent;
  });
}

/// The same whole decades on every panel, so that they can be compared.
void share_decades(std::vector<Panel>& panels) {
  Extent extent;
  for (const Panel& panel : panels) {
    for (const Series& series : panel.series) extent.take(series.x);
  }
  if (extent.empty()) return;
  const double first = std::pow(10.0, std::floor(std::log10(0.8 * extent.lower)));
  const double last = std::pow(10.0, std::ceil(std::log10(1.25 * extent.upper)));
  for (Panel& panel : panels) panel.x.range = {rounded(first, 3), rounded(last, 3)};
}

}  // namespace

Figure error_overview_figure(const StudyView& view) {
  Figure figure;
  figure.id = "error-overview";
  figure.kind = "scatter";
  figure.title = "Errors of the functions, and of the torque on held-out loops";
  figure.caption =
      "One line for each input, further right is worse, by decades. Look for symbols of one colour "
      "that stay left whatever the input hides.";
  figure.alt = "Errors in percent for every input and estimator on a logarithmic axis.";
  Frame frame;
  for (Panel& panel : std::vector<Panel>{
           function_panel(view, "f"), function_panel(view, "g_inverse"),
           torque_panel(view, "torque, lower amplitude", Elsewhere::lower_amplitude),
           torque_panel(view, "torque, lower frequency", Elsewhere::lower_frequency)}) {
    if (!panel.series.empty()) frame.panels.push_back(std::move(panel));
  }
  share_decades(frame.panels);
  if (!frame.panels.empty()) figure.frames.push_back(std::move(frame));
  return figure;
}

}  // namespace flexspline::reports
