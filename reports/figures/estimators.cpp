#include <algorithm>
#include <cmath>
#include <map>

#include "extent.hpp"
#include "figures/study_figures.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

/// Errors that exist, of the recordings of one estimator over all inputs.
template <class Of>
std::vector<double> errors_of(const StudyView& view, const EstimatorView& estimator, Of of) {
  std::vector<double> errors;
  for (const Input& input : view.artefacts().inputs) {
    const Case* item = view.find(input, estimator);
    if (item == nullptr) continue;
    for (const CaseRecording* recording : of(input, *item)) {
      const double error = recording->error_percent();
      if (error > 0.0 && std::isfinite(error)) errors.push_back(error);
    }
  }
  return errors;
}

void add(Series& series, double x, double row) {
  if (!std::isfinite(x)) return;
  series.x.push_back(x);
  series.y.push_back(row);
}

}  // namespace

Figure estimators_figure(const StudyView& view) {
  Figure figure;
  figure.id = "estimators";
  figure.kind = "scatter";
  figure.title = "Every estimator, on training and on held-out recordings";
  figure.caption =
      "Error in percent of peak, by decades. A fit that has found the physics has its diamonds and "
      "triangles near its circle; one that has found a curve through its loop has not.";
  figure.alt = "Median error on training recordings, median and worst on held-out ones.";
  Panel panel;
  panel.x.label = "error / % of peak";
  panel.x.log = true;
  panel.y.label = "estimator";
  Series own{"trained on, median", "points", {"plain", 0}, {}, {}, {}, {}};
  Series middle{"held out, median", "points", {"plain", 1}, {}, {}, {}, {}};
  Series worst{"held out, worst", "points", {"plain", 2}, {}, {}, {}, {}};
  Extent extent;
  for (const EstimatorView& estimator : view.estimators()) {
    const auto row = static_cast<double>(panel.y.categories.size());
    panel.y.categories.push_back(estimator.id);
    const auto given =
        errors_of(view, estimator, [](const Input&, const Case& item) { return item.trained(); });
    const auto unseen = errors_of(view, estimator, [&](const Input& input, const Case& item) {
      return view.held_out(input, item);
    });
    add(own, median(given), row);
    add(middle, median(unseen), row);
    add(worst, unseen.empty() ? kAbsent : *std::max_element(unseen.begin(), unseen.end()), row);
  }
  for (Series* series : {&own, &middle, &worst}) {
    extent.take(series->x);
    if (!series->x.empty()) panel.series.push_back(std::move(*series));
  }
  if (panel.series.empty()) return figure;
  panel.x.range = {std::pow(10.0, std::floor(std::log10(0.9 * extent.lower))),
                   std::pow(10.0, std::ceil(std::log10(1.1 * extent.upper)))};
  figure.frames.push_back({{}, {std::move(panel)}});
  return figure;
}

Figure convergence_figure(const StudyView& view) {
  Figure figure;
  figure.id = "convergence";
  figure.kind = "scatter";
  figure.title = "How much work each fit was";
  figure.caption =
      "Evaluations of the model until the fit ended; how it ended stands in the table. A fit that "
      "needs far more than its neighbours of one estimator is one to doubt.";
  figure.alt = "Number of evaluations of every fit, by input and estimator.";
  Panel panel;
  panel.x.label = "evaluations";
  panel.x.log = true;
  panel.y.label = "input";
  std::map<int, Series> lines;
  double upper = 10.0;
  for (const Input& input : view.artefacts().inputs) {
    const auto row = static_cast<double>(panel.y.categories.size());
    panel.y.categories.push_back(input.title);
    for (const EstimatorView& estimator : view.estimators()) {
      const Case* item = view.find(input, estimator);
      if (item == nullptr || !(item->evaluations > 0.0)) continue;
      Series& series = lines[estimator.rank];
      series.name = estimator.id;
      series.style = "points";
      series.role = role_of(estimator);
      add(series, item->evaluations, row);
      upper = std::max(upper, item->evaluations);
    }
  }
  for (auto& [rank, series] : lines) panel.series.push_back(std::move(series));
  if (panel.series.empty()) return figure;
  panel.x.range = {0.9, std::pow(10.0, std::ceil(std::log10(1.1 * upper)))};
  figure.frames.push_back({{}, {std::move(panel)}});
  return figure;
}

}  // namespace flexspline::reports
