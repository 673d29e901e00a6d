#include <algorithm>
#include <cmath>

#include "figures/study_figures.hpp"
#include "flexspline/reports/section.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

std::vector<double> held_out(const Case& item) {
  std::vector<double> errors;
  for (const CaseRecording& recording : item.recordings) {
    if (!recording.trained) errors.push_back(recording.error_percent());
  }
  return errors;
}

std::vector<Cell> row_of(const StudyView& view, const Input& input,
                         const EstimatorView& estimator) {
  const Case* item = view.find(input, estimator);
  if (item == nullptr) return {input.title, estimator.id, kAbsent, kAbsent, kAbsent, "not run"};
  if (item->failed) {
    const std::string remedy = item->remedy.empty() ? "" : "; " + item->remedy;
    return {input.title, estimator.id, kAbsent, kAbsent, kAbsent,
            "failed: " + item->failure + remedy};
  }
  const std::vector<double> errors = held_out(*item);
  const Worst worst = view.worst(input, estimator, Elsewhere::anywhere);
  return {input.title,     estimator.id,  static_cast<double>(errors.size()),
          median(errors), worst.percent, worst.where};
}

Table table_of(const StudyView& view) {
  Table table{"hold-out",
              "Error of the simulated effort on held-out recordings, in percent of each "
              "recording's peak: against the noise-free torque where the bench knows it, else "
              "against what was measured. The worst is taken over recordings that no estimator "
              "was trained on, where there are any.",
              {{"input", "", 3}, {"estimator", "", 3}, {"recordings held out", "", 3},
               {"median", "%", 2}, {"worst", "%", 2}, {"where, or why there is no number", "", 3}},
              {}};
  for (const Input& input : view.artefacts().inputs) {
    for (const EstimatorView& estimator : view.estimators()) {
      table.rows.push_back(row_of(view, input, estimator));
    }
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
  return answer + "on loops it had not seen, the worst error of " + paper->id + " is between " +
         digits(lowest, 2) + " % and " + digits(highest.percent, 2) + " % of peak (" +
         highest_input + " at " + highest.where + ").";
}

std::optional<Section> draw(const StudyView& view) {
  if (view.artefacts().cases.empty() || view.artefacts().inputs.empty()) return std::nullopt;
  Section section{"hold-out-section", "Does it hold at other amplitudes and frequencies?", {}};
  if (const std::string verdict = verdict_of(view); !verdict.empty()) section.add(Verdict{verdict});
  Figure map = error_map_figure(view);
  if (!map.frames.empty()) section.add(std::move(map));
  Figure loops = loops_figure(view);
  if (!loops.frames.empty()) section.add(std::move(loops));
  section.add(table_of(view));
  return section;
}

}  // namespace

SectionRow describe_hold_out() { return {20, draw}; }

}  // namespace flexspline::reports
