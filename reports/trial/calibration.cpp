#include "figures/trial_figures.hpp"
#include "flexspline/reports/trial_view.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

void add_rate(Table& table, std::vector<Cell> head, const ShownRate& rate) {
  for (const double value : {rate.count, rate.of}) head.emplace_back(value);
  for (const double share : {rate.rate, rate.lower, rate.upper}) head.emplace_back(100.0 * share);
  table.rows.push_back(std::move(head));
}

Table rate_columns(const char* id, const char* caption, std::vector<Column> head) {
  head.insert(head.end(), {{"cases", "", 0},
                           {"of", "", 0},
                           {"share", "%", 3},
                           {"from", "%", 3},
                           {"to (95 %)", "%", 3}});
  return {id, caption, std::move(head), {}};
}

Table groups_table(const char* id, const char* caption, const char* what,
                   const std::map<std::string, ShownScores>& groups) {
  Table table = rate_columns(id, caption, {{what, "", 3}, {"question", "", 3}});
  for (const auto& [group, scores] : groups) {
    for (const auto& [name, rate] : told_rates(scores)) {
      add_rate(table, {words(group), rate_title(name)}, rate);
    }
  }
  return table;
}

Table reliability_table(const TrialView& view) {
  Table table = rate_columns("trial-reliability", "Names by the probability printed with them.",
                             {{"printed from", "", 3}, {"to", "", 3}, {"mean", "", 3}});
  for (const ShownReliabilityBin& bin : view.reliability) {
    add_rate(table, {bin.from, bin.to, bin.mean_probability}, bin.right);
  }
  return table;
}

Table coverage_table(const TrialView& view) {
  Table table = rate_columns("trial-coverage",
                             "How often the 95 % interval of a parameter holds the truth, where "
                             "the bench has the parameter under the same name.",
                             {{"parameter", "", 3}});
  for (const auto& [name, rate] : view.coverage) add_rate(table, {words(name)}, rate);
  return table;
}

Table verdicts_table(const TrialView& view) {
  Table table{"trial-by-verdict",
              "Hold-out error over the noise by verdict: near 1 where nothing is left.",
              {{"verdict", "", 3}, {"cases", "", 0}, {"median", "", 3}},
              {}};
  for (const ShownVerdictError& one : view.by_verdict) {
    table.rows.push_back({words(one.verdict), one.cases, one.median});
  }
  return table;
}

Table splices_table(const TrialView& view) {
  Table table = rate_columns("trial-splices",
                             "Recordings by others: known effects added to their torque, and the "
                             "same recordings changed in ways that change no physics.",
                             {{"question", "", 3}});
  const auto add = [&table](const char* says, const ShownRate& rate) {
    if (rate.of > 0.0) add_rate(table, {says}, rate);
  };
  add("effect below 5 % of peak, named", view.splices.found_small);
  add("effect of 5 % and more, named", view.splices.found_large);
  add("changed, and the verdict the same", view.splices.same_verdict);
  return table;
}

void add_table(Section& section, Table table) {
  if (!table.rows.empty()) section.add(std::move(table));
}

std::optional<Section> draw(const TrialView& view) {
  Section section{"calibration-section", "Where, and how reliable a printed number is", {}};
  if (Figure figure = reliability_figure(view); !figure.frames.empty()) {
    section.add(std::move(figure));
  }
  add_table(section, reliability_table(view));
  add_table(section, groups_table("trial-by-generator", "The rates by generator.", "generator",
                                  view.by_generator));
  add_table(section,
            groups_table("trial-by-disturbance",
                         "The rates by what the bench was disturbed by without anything being "
                         "left out.",
                         "disturbance", view.by_disturbance));
  add_table(section, splices_table(view));
  add_table(section, verdicts_table(view));
  add_table(section, coverage_table(view));
  if (section.blocks.empty()) return std::nullopt;
  return section;
}

}  // namespace

TrialSectionRow describe_calibration() { return {15, draw}; }

}  // namespace flexspline::reports
