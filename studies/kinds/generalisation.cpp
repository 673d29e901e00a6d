#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "answers/kind_parts.hpp"
#include "answers/kind_tables.hpp"
#include "comparison/middle_of.hpp"
#include "flexspline/studies/kind.hpp"
#include "flexspline/studies/study_rows.hpp"

namespace flexspline::studies {
namespace {

constexpr std::size_t kMostSets = 500;
constexpr std::string_view kSet = "set-";

/// Every set of so many of n loops, in lexicographic order.
void add_sets(std::size_t n, std::size_t size, std::vector<std::vector<std::size_t>>& sets) {
  std::vector<std::size_t> one(size);
  for (std::size_t i = 0; i < size; ++i) one[i] = i;
  while (size > 0 && size <= n) {
    sets.push_back(one);
    std::size_t at = size;
    while (at > 0 && one[at - 1] == n - size + at - 1) --at;
    if (at == 0) return;
    ++one[at - 1];
    for (std::size_t i = at; i < size; ++i) one[i] = one[i - 1] + 1;
  }
}

void read(TomlSection& own, StudyConfig& study) {
  need_truths(own, study);
  const Grid* all = named_grid(own, "grid", study);
  const auto largest = own.integer("largest_set", 1, 6).value_or(2);
  study.settings.numbers["error_percent"] = percent_of(own, "error", 2.0);
  if (all == nullptr) return;
  const Grid conditions = *all;
  std::vector<std::vector<std::size_t>> sets;
  for (std::size_t size = 1; size <= static_cast<std::size_t>(largest); ++size) {
    add_sets(conditions.loops.size(), size, sets);
  }
  if (sets.size() > kMostSets) {
    return own.refuse(
        "largest_set",
        fmt::format("{} loops have {} sets of up to {}", conditions.loops.size(), sets.size(),
                    largest),
        fmt::format("take fewer loops or a smaller largest_set; {} sets are the most", kMostSets));
  }
  study.settings.words["grid"] = conditions.id;
  hold_out_everywhere(study, conditions.id);
  std::vector<EstimatorConfig> made;
  for (std::size_t s = 0; s < sets.size(); ++s) {
    Grid set{fmt::format("{}{}", kSet, s + 1), {}};
    for (const std::size_t loop : sets[s]) set.loops.push_back(conditions.loops[loop]);
    for (const EstimatorConfig& written : study.estimators) {
      EstimatorConfig& one = made.emplace_back(made_from(written, set.id));
      one.train = set.id;
    }
    study.grids.push_back(std::move(set));
  }
  study.estimators = std::move(made);
}

std::string set_text(const Grid& set) {
  std::vector<std::string> loops;
  for (const Loop& loop : set.loops) loops.push_back(recording_id(loop));
  return fmt::format("{}", fmt::join(loops, " + "));
}

/// Errors of one estimator, as written: median over inputs and replicates, by set and tested loop.
struct Matrix {
  std::map<std::string, std::map<std::string, std::vector<double>>> errors;

  double median(const std::string& set, const std::string& loop) const {
    const auto row = errors.find(set);
    if (row == errors.end()) return std::numeric_limits<double>::quiet_NaN();
    const auto cell = row->second.find(loop);
    return cell == row->second.end() ? std::numeric_limits<double>::quiet_NaN()
                                     : middle_of(cell->second);
  }
  /// The largest over the conditions; NaN where one of them is not there.
  double worst(const std::string& set, const Grid& conditions) const {
    double worst = 0.0;
    for (const Loop& loop : conditions.loops) {
      const double one = median(set, recording_id(loop));
      worst = std::isnan(one) ? one : std::max(worst, one);
      if (std::isnan(worst)) return worst;
    }
    return worst;
  }
};

/// "0.2/5": an axis has no room for more.
std::string short_name(const Loop& loop) {
  return fmt::format("{:.3g}/{:.3g}", loop.amplitude * 180.0 / std::numbers::pi,
                     1e3 * loop.frequency_hz);
}

AnswerPanel matrix_panel(const std::string& title, const Matrix& matrix, const StudyConfig& study,
                         const Grid& conditions) {
  AnswerPanel panel;
  panel.title = title;
  panel.x_label = "tested on, deg/mHz";
  panel.y_label = "trained on, deg/mHz";
  for (const Loop& loop : conditions.loops) panel.x_names.push_back(short_name(loop));
  for (const Grid& set : study.grids) {
    if (!set.id.starts_with(kSet) || set.loops.size() != 1) continue;
    panel.y_names.push_back(short_name(set.loops.front()));
    auto& row = panel.cells.emplace_back();
    for (const Loop& loop : conditions.loops)
      row.push_back(matrix.median(set.id, recording_id(loop)));
  }
  return panel;
}

KindAnswer answer(const StudyRows& rows) {
  const StudyConfig& study = rows.study();
  const Grid& conditions = *study.find_grid(study.settings.words.at("grid"));
  const double allowed = study.settings.numbers.at("error_percent");
  std::map<std::string, Matrix> by_estimator;
  constexpr std::string_view kHeld = "holdout/";
  rows.each([&](const CasePlan& one, const CaseRow& row) {
    Matrix& matrix = by_estimator[one.estimator->written_id()];
    for (const CaseRow::Recording& recording : row.recordings) {
      if (recording.role != "holdout") continue;
      matrix.errors[one.estimator->train][recording.id.substr(kHeld.size())].push_back(
          recording.error_percent);
    }
  });
  KindAnswer answer;
  AnswerFigure figure{"generalisation",
                      "Torque error by what was trained on and what is tested",
                      "Each row trained on one loop alone; median over inputs and replicates. "
                      "Recordings to test have noise of their own, also on the diagonal.",
                      "% of peak",
                      {}};
  AnswerTable table{"smallest-set",
                    fmt::format("The smallest set of loops whose largest error over all conditions "
                                "is at most {:g} % of peak, else the best set",
                                allowed),
                    {"estimator", "loops", "trained on", "largest error / % of peak", "suffices"},
                    {}};
  for (const auto& [estimator, matrix] : by_estimator) {
    figure.panels.push_back(matrix_panel(estimator, matrix, study, conditions));
    const Grid* best = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const Grid& set : study.grids) {
      if (!set.id.starts_with(kSet)) continue;
      if (least <= allowed && best != nullptr && set.loops.size() > best->loops.size()) break;
      const double worst = matrix.worst(set.id, conditions);
      if (!(worst < least)) continue;
      least = worst;
      best = &set;
    }
    if (best == nullptr) continue;
    const bool enough = least <= allowed;
    table.rows.push_back({estimator, static_cast<double>(best->loops.size()), set_text(*best),
                          least, std::string(enough ? "yes" : "no")});
    answer.says += fmt::format(
        "{}{}: {} ({}) {} an error of at most {:g} % of peak everywhere (largest {:.2g} %)",
        answer.says.empty() ? "" : "; ", estimator,
        best->loops.size() == 1 ? "one loop" : fmt::format("{} loops", best->loops.size()),
        set_text(*best), enough ? "suffice for" : "do best, short of", allowed, least);
  }
  answer.says += answer.says.empty() ? "No set of loops could be tested everywhere." : ".";
  answer.figures.push_back(std::move(figure));
  answer.tables.push_back(std::move(table));
  return answer;
}

}  // namespace

KindRow describe_generalisation() {
  return {.id = "generalisation",
          .summary = "trained on every small set of loops, tested on all",
          .cases = "inputs x estimators x sets of up to largest_set loops of a grid x replicates",
          .question = "Which loops have to be recorded for the others to be predicted?",
          .read = read,
          .answer = answer,
          .chooses_training = true};
}

}  // namespace flexspline::studies
