#include <cmath>
#include <set>

#include <fmt/format.h>

#include "flexspline/core/write_file.hpp"
#include "trial/trial_json.hpp"

namespace flexspline::studies {
namespace {

using Row = std::vector<std::string>;

/// A table of text: the first row is the header. No cell holds a comma or a bar.
struct TextTable {
  std::string name;
  std::vector<Row> rows;
};

std::string shown(double value) { return std::isfinite(value) ? fmt::format("{:.3g}", value) : ""; }

std::string percent(double share) {
  return std::isfinite(share) ? fmt::format("{:.1f}", 100.0 * share) : "";
}

std::string joined(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, " + "));
}

TextTable rates(const std::string& table_name, const TrialScores& scores) {
  TextTable table{table_name, {{"rate", "count", "of", "percent", "from", "to (95 %)"}}};
  for (const auto& [name, one] : scores.rates) {
    table.rows.push_back({name, std::to_string(one.count), std::to_string(one.of),
                          percent(one.rate()), percent(one.lower), percent(one.upper)});
  }
  return table;
}

TextTable scores(const TrialSummary& summary) {
  TextTable table{"scores", {{"score", "all", "that can be seen"}}};
  std::vector<TrialScores> columns = {score_trial(summary.cases),
                                      score_trial(that_can_be_seen(summary.cases))};
  for (const data::BenchKind rig : data::bench_kinds()) {
    const auto some = of_rig(summary.cases, rig);
    if (some.empty()) continue;
    columns.push_back(score_trial(some));
    table.rows.front().emplace_back(name_of(rig));
  }
  for (const auto& [name, value] : columns.front().counters) {
    Row& row = table.rows.emplace_back(Row{name});
    for (const TrialScores& column : columns) row.push_back(std::to_string(column.counter(name)));
  }
  for (const auto& [name, value] : columns.front().medians) {
    if (name.starts_with("seconds")) continue;
    Row& row = table.rows.emplace_back(Row{name});
    for (const TrialScores& column : columns) row.push_back(shown(column.median(name)));
  }
  return table;
}

/// A row for each rate of each group of cases.
TextTable grouped_rates(const std::string& name, const std::string& by,
                        const std::map<std::string, std::vector<ScoredCase>>& groups) {
  TextTable table{name, {{by, "rate", "count", "of", "percent", "from", "to (95 %)"}}};
  for (const auto& [group, cases] : groups) {
    for (Row& row : rates("", score_trial(cases)).rows) {
      if (row.front() == "rate" || row[2] == "0") continue;
      row.insert(row.begin(), group);
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

TextTable reliability(const std::vector<ScoredCase>& cases) {
  TextTable table{
      "reliability",
      {{"probability from", "to", "mean", "names", "right", "percent", "from", "to (95 %)"}}};
  for (const ReliabilityBin& bin : reliability_of(cases)) {
    table.rows.push_back({shown(bin.from), shown(bin.to), shown(bin.mean_probability),
                          std::to_string(bin.right.of), std::to_string(bin.right.count),
                          percent(bin.right.rate()), percent(bin.right.lower),
                          percent(bin.right.upper)});
  }
  return table;
}

TextTable confusion(const std::vector<ScoredCase>& cases) {
  const Confusion counts = confusion_of(cases);
  std::set<std::string> named;
  std::set<std::string> truths;
  for (const auto& [labels, count] : counts) {
    truths.insert(labels.first);
    named.insert(labels.second);
  }
  TextTable table{"confusion", {{"truth / first name"}}};
  table.rows.front().insert(table.rows.front().end(), named.begin(), named.end());
  for (const std::string& truth : truths) {
    Row& row = table.rows.emplace_back(Row{truth});
    for (const std::string& name : named) {
      const auto found = counts.find({truth, name});
      row.push_back(found == counts.end() ? "" : std::to_string(found->second));
    }
  }
  return table;
}

TextTable detection(const std::string& name, const std::string& what,
                    const std::vector<DetectionBin>& bins) {
  TextTable table{name,
                  {{what + " from %", "to %", "cases", "detected", "named first", "exactly"}}};
  for (const DetectionBin& bin : bins) {
    table.rows.push_back({percent(bin.from), percent(bin.to), std::to_string(bin.cases),
                          std::to_string(bin.detected), std::to_string(bin.first_right),
                          std::to_string(bin.exact)});
  }
  return table;
}

TextTable effects(const std::vector<ScoredCase>& cases) {
  TextTable table{
      "by_effect",
      {{"rig", "effect", "cases", "named first", "exactly", "located", "hold-out over noise"}}};
  for (const auto& [group, some] : by_effect(cases)) {
    const TrialScores one = score_trial(some);
    table.rows.push_back({group.first, group.second, std::to_string(one.counter("cases")),
                          std::to_string(one.counter("single_top")),
                          std::to_string(one.counter("single_exact")),
                          std::to_string(one.counter("coord_ok")),
                          shown(one.median("holdout_after_over_noise_median"))});
  }
  return table;
}

TextTable list(const std::vector<ScoredCase>& cases) {
  TextTable table{
      "cases",
      {{"case", "rig", "hidden", "size %", "trace %", "verdict", "named", "hold-out over noise"}}};
  for (const ScoredCase& one : cases) {
    std::vector<std::string> hidden;
    std::vector<std::string> size;
    std::vector<std::string> trace;
    for (const data::HiddenFinding& effect : one.answer.effects) {
      hidden.push_back(effect.id);
      size.push_back(percent(effect.size_fraction));
    }
    for (const EffectTrace& left : one.traces) trace.push_back(percent(left.share));
    table.rows.push_back({one.key, std::string(name_of(one.answer.rig)), joined(hidden),
                          joined(size), joined(trace), one.verdict, joined(one.named),
                          shown(one.score.after_over_noise)});
  }
  return table;
}

Result<void> write(const std::filesystem::path& folder, const TextTable& table) {
  std::string csv;
  std::string markdown;
  for (const Row& row : table.rows) {
    csv += fmt::format("{}\n", fmt::join(row, ","));
    markdown += fmt::format("| {} |\n", fmt::join(row, " | "));
    if (&row == &table.rows.front()) {
      for (std::size_t k = 0; k < row.size(); ++k) markdown += "|---";
      markdown += "|\n";
    }
  }
  const auto written = write_file(folder / (table.name + ".csv"), csv);
  return written ? write_file(folder / (table.name + ".md"), markdown) : written;
}

}  // namespace

Result<void> write_trial_tables(const TrialSummary& summary, const std::filesystem::path& folder) {
  const auto& cases = summary.cases;
  for (const TextTable& table :
       {scores(summary), rates("rates", score_trial(cases)),
        rates("rates_seen", score_trial(that_can_be_seen(cases))),
        grouped_rates("by_generator", "generator", by_generator(cases)),
        grouped_rates("by_disturbance", "disturbance", by_disturbance(cases)), reliability(cases),
        confusion(cases), detection("by_size", "size", detection_by_size(cases)),
        detection("by_trace", "trace", detection_by_trace(cases)), effects(cases), list(cases)}) {
    if (const auto written = write(folder, table); !written) return written;
  }
  return {};
}

}  // namespace flexspline::studies
