#include <algorithm>
#include <cmath>

#include "figures/study_figures.hpp"
#include "flexspline/reports/section.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

std::vector<double> errors_of(const std::vector<const CaseRecording*>& recordings) {
  std::vector<double> errors;
  for (const CaseRecording* recording : recordings) errors.push_back(recording->error_percent());
  return errors;
}

std::vector<Cell> row_of(const StudyView& view, const Input& input, const EstimatorView& estimator,
                         const Case& item) {
  if (item.failed) {
    const std::string remedy = item.remedy.empty() ? "" : "; " + item.remedy;
    return {input.title, estimator.id, kAbsent,
            kAbsent,     kAbsent,      "failed: " + item.failure + remedy};
  }
  const std::vector<double> errors = errors_of(view.held_out(input, item));
  const Worst worst = view.worst(input, estimator, Elsewhere::anywhere);
  return {input.title,    estimator.id,  static_cast<double>(errors.size()),
          median(errors), worst.percent, worst.where};
}

constexpr const char* kWhatIsShown =
    "Error of the simulated torque or force on held-out recordings, in percent of each recording's "
    "peak: "
    "against the noise-free torque where the bench knows it, else against what was measured. Held "
    "out are the recordings that no estimator was trained on; where there are none, those that "
    "this "
    "one was not.";

Table in_full(const StudyView& view) {
  Table table{"hold-out-every-estimator",
              kWhatIsShown,
              {{"input", "", 3},
               {"estimator", "", 3},
               {"recordings held out", "", 0},
               errors_of_signal("median"),
               errors_of_signal("worst"),
               {"where, or why there is no number", "", 3}},
              {}};
  for (const Input& input : view.artefacts().inputs) {
    for (const EstimatorView& estimator : view.estimators()) {
      const Case* item = view.find(input, estimator);
      if (item != nullptr) table.rows.push_back(row_of(view, input, estimator, *item));
    }
  }
  return table;
}

/// An input a row, the principal estimators side by side.
Table side_by_side(const StudyView& view) {
  Table table{"hold-out", kWhatIsShown, {{"input", "", 3}}, {}};
  const auto principal = view.principal();
  for (const EstimatorView* estimator : principal) {
    table.columns.push_back(errors_of_signal(estimator->id + ", median"));
    table.columns.push_back(errors_of_signal(estimator->id + ", worst"));
    table.columns.push_back({"worst at", "", 3});
  }
  for (const Input& input : view.artefacts().inputs) {
    std::vector<Cell> row{input.title};
    for (const EstimatorView* estimator : principal) {
      const Case* item = view.find(input, *estimator);
      const Worst worst = view.worst(input, *estimator, Elsewhere::anywhere);
      row.emplace_back(item != nullptr ? median(errors_of(view.held_out(input, *item))) : kAbsent);
      row.emplace_back(worst.percent);
      row.emplace_back(item == nullptr ? "not run" : item->failed ? "failed" : worst.where);
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// The input on which the paper's fit is worst away from its loop, told in a sentence.
std::string verdict_of(const StudyView& view) {
  const EstimatorView* paper = view.paper_fit();
  if (paper == nullptr) return {};
  double lowest = kAbsent;
  Worst highest;
  std::string highest_input;
  for (const Input& input : view.artefacts().inputs) {
    const Worst worst = view.worst(input, *paper, Elsewhere::anywhere);
    if (!std::isfinite(worst.percent)) continue;
    if (!(lowest <= worst.percent)) lowest = worst.percent;
    if (!(highest.percent >= worst.percent)) {
      highest = worst;
      highest_input = input.title;
    }
  }
  if (!std::isfinite(highest.percent)) return {};
  const std::string answer = highest.percent < 2.0 ? "Yes: " : "No: ";
  return answer + "torque error of " + paper->id +
         " on the worst held-out loop of an input: " + of_peak(lowest) + " at best, " +
         of_peak(highest.percent) + " at worst (" + highest_input + " at " + highest.where + ").";
}

std::optional<Section> draw(const StudyView& view) {
  if (view.artefacts().cases.empty() || view.artefacts().inputs.empty()) return std::nullopt;
  Section section{"hold-out-section", "Does it hold at other amplitudes and frequencies?", {}};
  if (const std::string verdict = verdict_of(view); !verdict.empty()) section.add(Verdict{verdict});
  Figure map = error_map_figure(view);
  if (!map.frames.empty()) section.add(std::move(map));
  Figure loops = loops_figure(view);
  if (!loops.frames.empty()) section.add(std::move(loops));
  if (!view.principal().empty()) section.add(side_by_side(view));
  section.fold("Every estimator, and what failed", in_full(view));
  return section;
}

}  // namespace

SectionRow describe_hold_out() { return {20, draw}; }

}  // namespace flexspline::reports
