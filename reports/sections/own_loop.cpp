#include <cmath>

#include "figures/study_figures.hpp"
#include "flexspline/reports/section.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

const CaseRecording* own(const StudyView& view, const Input& input,
                         const EstimatorView& estimator) {
  const Case* item = view.find(input, estimator);
  return item != nullptr ? item->recording(view.operating_point(input).recording) : nullptr;
}

Table table_of(const StudyView& view) {
  Table table{"own-loop", "RMSE on the loop at the operating point, in percent of its peak "
                          "(measured against simulated), and the error of the loop's area.",
              {{"input", "", 3}, {"loop", "", 3}}, {}};
  for (const EstimatorView& estimator : view.estimators()) {
    table.columns.push_back({estimator.id + ", rmse", "%", 2});
    table.columns.push_back({estimator.id + ", area", "%", 2});
  }
  for (const Input& input : view.artefacts().inputs) {
    std::vector<Cell> row{input.title, view.operating_point(input).recording};
    for (const EstimatorView& estimator : view.estimators()) {
      const CaseRecording* fit = own(view, input, estimator);
      row.emplace_back(fit != nullptr ? fit->rmse_percent : kAbsent);
      row.emplace_back(fit != nullptr ? fit->area_error_percent : kAbsent);
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::string verdict_of(const StudyView& view) {
  const EstimatorView* paper = view.paper_fit();
  if (paper == nullptr) return {};
  double worst = kAbsent;
  std::string where;
  for (const Input& input : view.artefacts().inputs) {
    const CaseRecording* fit = own(view, input, *paper);
    if (fit == nullptr || !std::isfinite(fit->rmse_percent)) continue;
    if (!(worst >= fit->rmse_percent)) {
      worst = fit->rmse_percent;
      where = input.title;
    }
  }
  if (!std::isfinite(worst)) return "The paper's fit gave no loop to look at.";
  const std::string answer = worst < 2.0 ? "Yes: " : worst < 5.0 ? "Roughly: " : "Not everywhere: ";
  return answer + "on the loop it was fitted to, " + paper->id + " is off by at most " +
         digits(worst, 2) + " % of peak, measurement noise included (" + where + ").";
}

std::optional<Section> draw(const StudyView& view) {
  if (view.artefacts().cases.empty() || view.artefacts().inputs.empty()) return std::nullopt;
  Section section{"own-loop-section", "Does the paper's fit hold on its own loop?", {}};
  if (const std::string verdict = verdict_of(view); !verdict.empty()) section.add(Verdict{verdict});
  Figure figure = own_loop_figure(view);
  if (!figure.frames.empty()) section.add(std::move(figure));
  section.add(table_of(view));
  return section;
}

}  // namespace

SectionRow describe_own_loop() { return {10, draw}; }

}  // namespace flexspline::reports
