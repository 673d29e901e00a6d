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

/// An input a row, the principal estimators side by side.
Table side_by_side(const StudyView& view) {
  Table table{"own-loop",
              "RMSE on the loop at the operating point in percent of its peak, measured against "
              "simulated, and the error of the loop's area.",
              {{"input", "", 3}, {"loop", "", 3}},
              {}};
  const auto principal = view.principal();
  for (const EstimatorView* estimator : principal) {
    table.columns.push_back(errors_of_signal(estimator->id + ", rmse"));
    table.columns.push_back(errors_of_signal(estimator->id + ", area"));
  }
  for (const Input& input : view.artefacts().inputs) {
    std::vector<Cell> row{input.title, view.operating_point(input).recording};
    for (const EstimatorView* estimator : principal) {
      const CaseRecording* fit = own(view, input, *estimator);
      row.emplace_back(fit != nullptr ? fit->rmse_percent : kAbsent);
      row.emplace_back(fit != nullptr ? fit->area_error_percent : kAbsent);
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table in_full(const StudyView& view) {
  Table table{"own-loop-every-estimator",
              "The same for every estimator, in Nm (N) too.",
              {{"input", "", 3},
               {"estimator", "", 3},
               {"rmse", "Nm or N", 3},
               errors_of_signal("rmse"),
               errors_of_signal("area")},
              {}};
  for (const Input& input : view.artefacts().inputs) {
    for (const EstimatorView& estimator : view.estimators()) {
      const CaseRecording* fit = own(view, input, estimator);
      if (fit == nullptr) continue;
      table.rows.push_back(
          {input.title, estimator.id, fit->rmse, fit->rmse_percent, fit->area_error_percent});
    }
  }
  return table;
}

std::string verdict_of(const StudyView& view) {
  const EstimatorView* paper = view.paper_fit();
  if (paper == nullptr) return {};
  Worst worst;
  for (const Input& input : view.artefacts().inputs) {
    const CaseRecording* fit = own(view, input, *paper);
    if (fit == nullptr || !std::isfinite(fit->rmse_percent)) continue;
    if (!(worst.percent >= fit->rmse_percent)) worst = {fit->rmse_percent, input.title};
  }
  if (!std::isfinite(worst.percent)) return "The paper's fit gave no loop to look at.";
  const std::string answer = worst.percent < 2.0   ? "Yes: "
                             : worst.percent < 5.0 ? "Roughly: "
                                                   : "Not everywhere: ";
  return answer + "largest torque error of " + paper->id +
         " on the loop it was fitted to: " + of_peak(worst.percent) +
         ", measurement noise included (" + worst.where + ").";
}

std::optional<Section> draw(const StudyView& view) {
  if (view.artefacts().cases.empty() || view.artefacts().inputs.empty()) return std::nullopt;
  Section section{"own-loop-section", "Does the paper's fit hold on its own loop?", {}};
  if (const std::string verdict = verdict_of(view); !verdict.empty()) section.add(Verdict{verdict});
  Figure figure = own_loop_figure(view);
  if (!figure.frames.empty()) section.add(std::move(figure));
  if (!view.principal().empty()) section.add(without_empty_columns(side_by_side(view)));
  section.fold("Every estimator on this loop", in_full(view));
  return section;
}

}  // namespace

SectionRow describe_own_loop() { return {10, draw}; }

}  // namespace flexspline::reports
