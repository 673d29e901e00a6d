#include "answers/cause_discrimination.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>

#include <fmt/format.h>

#include "answers/kind_parts.hpp"
#include "comparison/middle_of.hpp"
#include "flexspline/studies/study_rows.hpp"

namespace flexspline::studies {
namespace {

/// Of one input: [suffix][replicate] n ln C of both causes.
struct Costs {
  double first = std::numeric_limits<double>::quiet_NaN();
  double second = first;
};
using OfInput = std::map<std::string, std::map<int, Costs>>;

std::map<std::string, OfInput> costs_of(const StudyRows& rows,
                                        const std::vector<std::string>& causes) {
  std::map<std::string, OfInput> found;
  rows.each([&](const CasePlan& one, const CaseRow& row) {
    const std::string& written = one.estimator->written_id();
    if (written != causes[0] && written != causes[1]) return;
    const std::string suffix = one.estimator->id.substr(written.size() + 1);
    Costs& costs = found[one.input->id][suffix][one.replicate];
    (written == causes[0] ? costs.first : costs.second) =
        residuals_of(one, row) * std::log(row.number("cost"));
  });
  return found;
}

/// For the first cause where positive, for the second where negative; NaN: not both were fitted.
double discrimination(const OfInput& costs, const std::string& suffix) {
  const auto found = costs.find(suffix);
  if (found == costs.end()) return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> differences;
  for (const auto& [replicate, one] : found->second) {
    if (!std::isnan(one.second - one.first)) differences.push_back(one.second - one.first);
  }
  return middle_of(differences);
}

}  // namespace

void add_discrimination(const StudyRows& rows, const std::vector<std::string>& causes,
                        const std::string& recorded, const std::vector<std::string>& suffixes,
                        const std::vector<Loop>& candidates, KindAnswer& answer) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  AnswerFigure figure{
      "discrimination",
      fmt::format("Discrimination between {} and {}", causes[0], causes[1]),
      "Difference of -2 ln L between the causes, in favour of the one in the title, with the "
      "candidate added to what is recorded.",
      "",
      {}};
  AnswerTable table{
      "discrimination",
      "Difference of -2 ln L between the two causes, recorded alone and with one "
      "recording more",
      {"input", "amplitude / deg", "frequency / Hz", "recorded alone", "with it", "for"},
      {}};
  for (const auto& [input, costs] : costs_of(rows, causes)) {
    const double alone = discrimination(costs, recorded);
    std::vector<double> with;
    std::size_t best = candidates.size();
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      with.push_back(discrimination(costs, suffixes[k]));
      if (std::isnan(with[k])) continue;
      table.rows.push_back({input, kDegrees * candidates[k].amplitude, candidates[k].frequency_hz,
                            alone, with[k], causes[with[k] > 0.0 ? 0 : 1]});
      if (best == candidates.size() || std::abs(with[k]) > std::abs(with[best])) best = k;
    }
    if (best == candidates.size()) continue;
    const std::string& better = causes[with[best] > 0.0 ? 0 : 1];
    std::vector<double> cells = with;
    if (with[best] < 0.0) std::ranges::transform(with, cells.begin(), std::negate<>());
    figure.panels.push_back(
        loop_cells(fmt::format("{}: for {}", input, better), candidates, cells));
    answer.says += fmt::format(
        "{}if the gear is like {}, record {:.3g} deg at {:g} Hz: -2 ln L then differs by {:.3g} in "
        "favour of {}, by what is recorded alone by {:.3g}",
        answer.says.empty() ? "Of the two causes: " : "; ", input,
        kDegrees * candidates[best].amplitude, candidates[best].frequency_hz, std::abs(with[best]),
        better, std::abs(alone));
  }
  if (figure.panels.empty()) return;
  answer.figures.insert(answer.figures.begin(), std::move(figure));
  answer.tables.insert(answer.tables.begin(), std::move(table));
}

}  // namespace flexspline::studies
