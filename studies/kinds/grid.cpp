#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "answers/kind_parts.hpp"
#include "flexspline/studies/kind.hpp"
#include "flexspline/studies/study_rows.hpp"

namespace flexspline::studies {
namespace {

/// Errors over the first sweep, the others and the replicates taken together by their median.
KindAnswer answer(const StudyRows& rows) {
  const StudyConfig& study = rows.study();
  if (study.sweeps.empty()) return {};
  const SweepAxis& sweep = study.sweeps.front();
  Gathered held;  // by estimator and point
  rows.each([&](const CasePlan& one, const CaseRow& row) {
    const std::size_t point = point_of(study, one.variant).front();
    held[one.estimator->id][sweep_position(sweep, point)].push_back(
        row.number("holdout_median_percent"));
  });
  KindAnswer answer;
  answer.figures = {{"sweep",
                     "Held-out error over " + sweep.id,
                     "Median over inputs, replicates and the other sweeps.",
                     "",
                     {lines_of(held, sweep_label(sweep), "torque error / % of peak")}}};
  answer.tables = {
      table_of("sweep", "Median held-out torque error, % of peak", held, sweep_label(sweep))};
  answer.says = extremes_sentence(held, sweep.id);
  return answer;
}

}  // namespace

KindRow describe_grid() {
  return {.id = "grid",
          .summary = "estimators against inputs, held out by whole recordings",
          .cases = "every input x the estimators named for it x replicates x points of the sweeps",
          .question = "How does the held-out error follow what is swept?",
          .answer = answer};
}

}  // namespace flexspline::studies
