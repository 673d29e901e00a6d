#include <algorithm>
#include <cmath>

#include "figures/study_figures.hpp"
#include "flexspline/reports/section.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

double function_error(const StudyView& view, const Input& input, const EstimatorView& estimator,
                      const std::string& function) {
  const Case* item = view.find(input, estimator);
  if (item == nullptr) return kAbsent;
  const auto found = item->function_errors_percent.find(function);
  return found == item->function_errors_percent.end() ? kAbsent : found->second;
}

struct TorqueColumn {
  const char* name;
  Elsewhere elsewhere;
};

constexpr TorqueColumn kTorqueColumns[] = {{"lower amplitude", Elsewhere::lower_amplitude},
                                           {"lower frequency", Elsewhere::lower_frequency},
                                           {"beyond the loop", Elsewhere::beyond}};

/// An input a row, the principal estimators side by side.
Table side_by_side(const StudyView& view) {
  const auto principal = view.principal();
  Table table{
      "paper-against-full",
      "Errors in percent: of f and g⁻¹ over the training range, of their edge values; of the "
      "torque, the worst held-out recording, of its peak: smaller than the operating point's loop "
      "at its frequency, slower at its amplitude, and larger or faster than it.",
      {{"input", "", 3}},
      {}};
  const auto each = [&](const std::string& quantity) {
    for (const EstimatorView* estimator : principal) {
      table.columns.push_back(errors_of_signal(quantity + ", " + estimator->id));
    }
  };
  for (const char* function : {"f", "g_inverse"}) each(function_label(function));
  for (const TorqueColumn& column : kTorqueColumns) each(column.name);
  for (const Input& input : view.artefacts().inputs) {
    std::vector<Cell> row{input.title};
    for (const char* function : {"f", "g_inverse"}) {
      for (const EstimatorView* estimator : principal) {
        row.emplace_back(function_error(view, input, *estimator, function));
      }
    }
    for (const TorqueColumn& column : kTorqueColumns) {
      for (const EstimatorView* estimator : principal) {
        row.emplace_back(view.worst(input, *estimator, column.elsewhere).percent);
      }
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// Every estimator, with the recording on which it is worst.
Table in_full(const StudyView& view) {
  Table table{"function-and-effort-errors",
              "The same for every estimator, with the recording on which it is worst.",
              {{"input", "", 3},
               {"estimator", "", 3},
               errors_of_signal("f"),
               errors_of_signal("g⁻¹"),
               errors_of_signal("h")},
              {}};
  for (const TorqueColumn& column : kTorqueColumns) {
    table.columns.push_back(errors_of_signal(std::string("torque, ") + column.name));
    table.columns.push_back({"worst at", "", 3});
  }
  for (const Input& input : view.artefacts().inputs) {
    for (const EstimatorView& estimator : view.estimators()) {
      if (view.find(input, estimator) == nullptr) continue;
      std::vector<Cell> row{input.title, estimator.id};
      for (const char* function : {"f", "g_inverse", "h"}) {
        row.emplace_back(function_error(view, input, estimator, function));
      }
      for (const TorqueColumn& column : kTorqueColumns) {
        const Worst worst = view.worst(input, estimator, column.elsewhere);
        row.emplace_back(worst.percent);
        row.emplace_back(worst.where);
      }
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

/// Over all inputs on which the full trajectory ran too, on smaller and slower loops; where there
/// are none, on any that were held out.
Worst worst_of(const StudyView& view, const EstimatorView& estimator, bool inside) {
  Worst all;
  const std::vector<Elsewhere> within = {Elsewhere::lower_amplitude, Elsewhere::lower_frequency};
  for (const Input& input : view.artefacts().inputs) {
    if (view.find(input, *view.full_trajectory()) == nullptr) continue;
    for (const Elsewhere elsewhere : inside ? within : std::vector{Elsewhere::anywhere}) {
      const Worst one = view.worst(input, estimator, elsewhere);
      if (std::isfinite(one.percent) && !(all.percent >= one.percent)) {
        all = {one.percent, input.title + " at " + one.where};
      }
    }
  }
  return all;
}

std::string verdict_of(const StudyView& view) {
  const EstimatorView* full = view.full_trajectory();
  if (full == nullptr) return "No full-trajectory estimator is part of this folder.";
  const bool inside = std::isfinite(worst_of(view, *full, true).percent);
  const Worst mine = worst_of(view, *full, inside);
  if (!std::isfinite(mine.percent)) return full->id + " has no held-out loop to be judged on.";
  std::string text = mine.percent < 2.0 ? "Yes: " : mine.percent < 5.0 ? "Roughly: " : "No: ";
  text += inside ? "on smaller and slower loops than the operating point's, "
                 : "on held-out recordings, ";
  text += "largest torque error of " + full->id + ": " + of_peak(mine.percent) + " (" + mine.where +
          ")";
  const EstimatorView* paper = view.paper_fit();
  const Worst theirs = paper != nullptr ? worst_of(view, *paper, inside) : Worst{};
  if (std::isfinite(theirs.percent)) {
    text += "; of " + paper->id + ": " + of_peak(theirs.percent) + " (" + theirs.where + ")";
  }
  return text + ".";
}

std::optional<Section> draw(const StudyView& view) {
  if (view.artefacts().cases.empty() || view.artefacts().inputs.empty()) return std::nullopt;
  Section section{"full-trajectory-section", "Does the full trajectory?", {}};
  section.add(Verdict{verdict_of(view)});
  Figure figure = error_overview_figure(view);
  if (!figure.frames.empty()) section.add(std::move(figure));
  if (!view.principal().empty()) section.add(without_empty_columns(side_by_side(view)));
  section.fold("Every estimator, and where it is worst", without_empty_columns(in_full(view)));
  return section;
}

}  // namespace

SectionRow describe_full_trajectory() { return {30, draw}; }

}  // namespace flexspline::reports
