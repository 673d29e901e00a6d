#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "answers/kind_tables.hpp"
#include "answers/sobol_indices.hpp"
#include "config/study_source.hpp"
#include "flexspline/core/nearest_name.hpp"
#include "flexspline/studies/kind.hpp"
#include "flexspline/studies/study_rows.hpp"

namespace flexspline::studies {
namespace {

constexpr std::string_view kOutputs[] = {"holdout_median_percent",
                                         "holdout_worst_percent",
                                         "error_f_percent",
                                         "error_g_inverse_percent",
                                         "error_h_percent",
                                         "loop_area",
                                         "peak_torque"};

void read(TomlSection& own, StudyConfig& study) {
  const std::string method = own.text("method").value_or("sobol");
  const bool sobol = method == "sobol";
  if (!sobol && method != "morris") {
    own.refuse("method", fmt::format("there is no method '{}'", method), "use sobol, or morris");
  }
  const auto samples = static_cast<std::size_t>(own.integer("samples", 4, 1'000'000).value_or(64));
  auto outputs = own.texts("outputs");
  if (outputs.empty()) outputs = {"holdout_median_percent", "loop_area", "peak_torque"};
  for (const std::string& one : outputs) {
    if (std::ranges::find(kOutputs, one) != std::end(kOutputs)) continue;
    own.refuse("outputs", fmt::format("there is no output '{}'", one), suggestion(one, kOutputs));
  }
  const auto ranges = read_sweep_ranges(own);
  if (ranges.empty()) return;
  const auto design = sobol ? saltelli_design(samples, ranges.size())
                            : morris_design(samples, ranges.size(), study.seed);
  SweepAxis sweep{"sensitivity", {}, {}};
  for (const SweepRange& range : ranges) {
    sweep.keys.push_back(range.key);
    study.settings.names["keys"].push_back(range.key.path);
  }
  for (const auto& u : design) {
    auto& point = sweep.points.emplace_back();
    for (std::size_t i = 0; i < u.size(); ++i) point.push_back(ranges[i].at(u[i]));
  }
  study.sweeps.push_back(std::move(sweep));
  study.settings.words["method"] = method;
  study.settings.names["outputs"] = std::move(outputs);
  study.settings.numbers["samples"] = static_cast<double>(samples);
}

/// Values of one output at every point of the design, replicates and other sweeps averaged.
using Values = std::map<std::pair<std::string, std::string>, std::vector<double>>;  // by cell

Values values_of(const StudyRows& rows, const std::string& output) {
  const StudyConfig& study = rows.study();
  const std::size_t points = study.sweeps.back().points.size();
  std::map<std::pair<std::string, std::string>, std::vector<std::pair<double, int>>> sums;
  rows.each([&](const CasePlan& one, const CaseRow& row) {
    auto& list = sums[{one.input->id, one.estimator->id}];
    list.resize(points);
    auto& [sum, count] = list[point_of(study, one.variant).back()];
    sum += row.number(output);
    ++count;
  });
  Values values;
  for (const auto& [cell, list] : sums) {
    for (const auto& [sum, count] : list) {
      values[cell].push_back(count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN());
    }
  }
  return values;
}

std::vector<std::pair<double, double>> indices_of(const StudyConfig& study,
                                                  const std::vector<double>& values,
                                                  AnswerTable& table, const std::string& where,
                                                  const std::string& output) {
  const auto& keys = study.settings.names.at("keys");
  std::vector<std::pair<double, double>> pairs;
  if (study.settings.words.at("method") == "sobol") {
    const auto indices = sobol_indices(values, keys.size());
    for (std::size_t i = 0; i < keys.size(); ++i) {
      pairs.emplace_back(indices[i].first, indices[i].total);
      table.rows.push_back({where, output, keys[i], indices[i].first, indices[i].first_std,
                            indices[i].total, indices[i].total_std});
    }
    return pairs;
  }
  const auto design = morris_design(static_cast<std::size_t>(study.settings.numbers.at("samples")),
                                    keys.size(), study.seed);
  const auto effects = morris_effects(design, values, keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    pairs.emplace_back(effects[i].mean_abs, effects[i].deviation);
    table.rows.push_back({where, output, keys[i], effects[i].mean_abs, effects[i].mean,
                          effects[i].deviation, std::numeric_limits<double>::quiet_NaN()});
  }
  return pairs;
}

KindAnswer answer(const StudyRows& rows) {
  const StudyConfig& study = rows.study();
  const bool sobol = study.settings.words.at("method") == "sobol";
  const auto& keys = study.settings.names.at("keys");
  KindAnswer answer;
  AnswerTable table{
      "sensitivity",
      sobol ? "Sobol's indices, with the jackknife's standard deviations"
            : "Morris's effects, over the whole range of each key",
      sobol ? std::vector<std::string>{"case", "output", "key", "first order", "std", "total",
                                       "std of total"}
            : std::vector<std::string>{"case", "output", "key", "mu*", "mu", "sigma", ""},
      {}};
  AnswerFigure figure{"sensitivity",
                      "What the outputs depend on",
                      sobol
                          ? "Share of the output's variance: by a key alone, and with all that it "
                            "interacts in."
                          : "Mean size of an elementary effect (importance) and its spread "
                            "(interaction or curvature).",
                      "",
                      {}};
  for (const std::string& output : study.settings.names.at("outputs")) {
    for (const auto& [cell, values] : values_of(rows, output)) {
      const std::string where = cell.first + ", " + cell.second;
      const auto pairs = indices_of(study, values, table, where, output);
      AnswerPanel panel;
      panel.title = output + ": " + where;
      panel.x_label = sobol ? "share of the variance" : "effect over the range";
      panel.y_names = keys;
      AnswerSeries one{sobol ? "first order" : "mu*", "points", {}, {}};
      AnswerSeries other{sobol ? "total" : "sigma", "points", {}, {}};
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        one.x.push_back(pairs[i].first);
        other.x.push_back(pairs[i].second);
        one.y.push_back(static_cast<double>(i));
        other.y.push_back(static_cast<double>(i));
      }
      panel.series = {one, other};
      figure.panels.push_back(std::move(panel));
      const auto most = std::ranges::max_element(pairs, [&](const auto& a, const auto& b) {
        return (sobol ? a.second : a.first) < (sobol ? b.second : b.first);
      });
      if (most == pairs.end() || std::isnan(most->first)) continue;
      answer.says +=
          fmt::format("{}{} of {} depends most on {}{}", answer.says.empty() ? "" : "; ", output,
                      where, keys[static_cast<std::size_t>(most - pairs.begin())],
                      sobol ? fmt::format(" (total index {:.2g})", most->second) : "");
    }
  }
  answer.says += answer.says.empty() ? "No output varies." : ".";
  answer.figures.push_back(std::move(figure));
  answer.tables.push_back(std::move(table));
  return answer;
}

}  // namespace

KindRow describe_sensitivity() {
  return {.id = "sensitivity",
          .summary = "Sobol's indices or Morris's screening of outputs to keys of the study file",
          .cases =
              "inputs x estimators x replicates x points of the design: samples (keys + 2) of "
              "Sobol's, samples (keys + 1) of Morris's",
          .question = "What do the outputs depend on?",
          .read = read,
          .answer = answer};
}

}  // namespace flexspline::studies
