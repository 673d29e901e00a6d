#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <boost/math/distributions/beta.hpp>

#include "answers/kind_tables.hpp"
#include "flexspline/studies/kind.hpp"
#include "flexspline/studies/study_rows.hpp"

namespace flexspline::studies {
namespace {

constexpr std::string_view kStart = "start-";

/// Every estimator that fits a model file, from many starts, each a case of its own.
void read(TomlSection& own, StudyConfig& study) {
  const auto starts = own.integer("starts", 2, 10'000).value_or(20);
  study.settings.numbers["same_cost"] =
      own.has("same_cost") ? own.number("same_cost").value_or(1e-3) : 1e-3;
  std::vector<EstimatorConfig> made;
  for (const EstimatorConfig& written : study.estimators) {
    if (!written.model) {
      own.refuse("",
                 fmt::format("estimator '{}' fits no model file, so it has no starts to choose",
                             written.id),
                 "use method = \"model_file\" with model = \"…\"");
      continue;
    }
    for (std::int64_t k = 0; k < starts; ++k) {
      EstimatorConfig& one = made.emplace_back(made_from(written, fmt::format("{}{}", kStart, k)));
      one.options.numbers["starts"] = 1;
      one.options.numbers["first_start"] = static_cast<double>(k);
      // The search of the shapes would lead every start to one place before the fit begins.
      one.options.numbers["start_steps"] = 0;
    }
  }
  if (!made.empty()) study.estimators = std::move(made);
}

struct Basin {
  double cost = 0.0;
  std::size_t starts = 0;
};

/// Costs that differ by no more than the share are one minimum.
std::vector<Basin> basins_of(std::vector<double> costs, double same) {
  std::ranges::sort(costs);
  std::vector<Basin> basins;
  for (const double cost : costs) {
    if (basins.empty() || cost > (1.0 + same) * basins.back().cost) basins.push_back({cost, 0});
    ++basins.back().starts;
  }
  return basins;
}

KindAnswer answer(const StudyRows& rows) {
  const StudyConfig& study = rows.study();
  const double same = study.settings.numbers.at("same_cost");
  std::map<std::string, std::vector<double>> costs;
  rows.each([&](const CasePlan& one, const CaseRow& row) {
    const double cost = row.number("cost");
    if (std::isnan(cost)) return;
    costs[fmt::format("{}, {}{}", one.input->id, one.estimator->written_id(),
                      one.replicate > 0 ? fmt::format(", r{}", one.replicate) : "")]
        .push_back(cost);
  });
  std::map<std::string, std::size_t> planned;
  for (const EstimatorConfig& one : study.estimators) ++planned[one.written_id()];
  const auto starts = static_cast<double>(planned.empty() ? 0 : planned.begin()->second);
  KindAnswer answer;
  AnswerTable table{"multistart",
                    fmt::format("Where the starts end; costs within {:g} are one "
                                "minimum, a start without a result counts as one that "
                                "does not reach the best",
                                same),
                    {"case", "starts", "with a result", "at the best cost", "share / %", "from / %",
                     "to / %", "different minima", "worst over best cost"},
                    {}};
  AnswerFigure figure{"multistart",
                      "Costs by rank",
                      "Every start's final cost over the best; level steps are minima.",
                      "",
                      {{}}};
  AnswerPanel& panel = figure.panels.front();
  panel.x_label = "start, by its cost";
  panel.y_label = "cost over the best";
  for (auto& [name, list] : costs) {
    const auto basins = basins_of(list, same);
    const auto best = static_cast<double>(basins.front().starts);
    using Beta = boost::math::beta_distribution<>;
    const double lower = best > 0 ? quantile(Beta(best, starts - best + 1.0), 0.025) : 0.0;
    const double upper = best < starts ? quantile(Beta(best + 1.0, starts - best), 0.975) : 1.0;
    std::ranges::sort(list);
    table.rows.push_back({name, starts, static_cast<double>(list.size()), best,
                          100.0 * best / starts, 100.0 * lower, 100.0 * upper,
                          static_cast<double>(basins.size()), list.back() / list.front()});
    AnswerSeries series{name, "points", {}, {}};
    for (std::size_t i = 0; i < list.size(); ++i) {
      series.x.push_back(static_cast<double>(i + 1));
      series.y.push_back(list[i] / list.front());
    }
    panel.y_log = panel.y_log || list.back() > 10.0 * list.front();
    panel.series.push_back(std::move(series));
    answer.says += fmt::format(
        "{}{}: {:.0f} of {:.0f} starts reach the best cost ({:.0f} %, 95 %: "
        "{:.0f} to {:.0f} %); {} different {}",
        answer.says.empty() ? "" : "; ", name, best, starts, 100.0 * best / starts, 100.0 * lower,
        100.0 * upper, basins.size(), basins.size() == 1 ? "minimum" : "minima");
  }
  answer.says += answer.says.empty() ? "No start gave a result." : ".";
  answer.figures.push_back(std::move(figure));
  answer.tables.push_back(std::move(table));
  return answer;
}

}  // namespace

KindRow describe_multistart() {
  return {.id = "multistart",
          .summary = "a model file fitted from many starts: how many minima, how often the best",
          .cases = "inputs x estimators with a model x starts x replicates",
          .question = "How rough is the landscape of the cost?",
          .read = read,
          .answer = answer};
}

}  // namespace flexspline::studies
