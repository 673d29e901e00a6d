#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "answers/kind_parts.hpp"
#include "answers/kind_tables.hpp"
#include "comparison/middle_of.hpp"
#include "flexspline/studies/kind.hpp"
#include "flexspline/studies/study_rows.hpp"

namespace flexspline::studies {
namespace {

/// A key of [bench] that may be disturbed, its value there in the unit of the list, and the unit.
struct Disturbance {
  const char* key;
  const char* unit;
  double (*value)(const BenchConfig&);
  bool whole = false;
};

constexpr double kPercent = 100.0;

const Disturbance kDisturbances[] = {
    {"angle_noise", "%", [](const BenchConfig& b) { return kPercent * b.sensors.angle_noise; }},
    {"torque_noise_white", "%",
     [](const BenchConfig& b) { return kPercent * b.sensors.torque_noise_white; }},
    {"torque_noise_coloured", "%",
     [](const BenchConfig& b) { return kPercent * b.sensors.torque_noise_coloured; }},
    {"torque_noise_samples", "",
     [](const BenchConfig& b) { return b.sensors.torque_noise_samples; }, true},
    {"encoder_step", "rad", [](const BenchConfig& b) { return b.sensors.encoder_step; }},
    {"samples_per_cycle", "", [](const BenchConfig& b) { return double(b.samples_per_cycle); },
     true},
    {"time_jitter", "%", [](const BenchConfig& b) { return kPercent * b.sensors.time_jitter; }},
    {"missing_samples", "%",
     [](const BenchConfig& b) { return kPercent * b.sensors.missing_samples; }}};

SweepValue value_of(const Disturbance& one, double number) {
  if (one.whole) return static_cast<std::int64_t>(std::llround(number));
  return number;
}

/// Levels of one disturbance, in its unit.
std::vector<double> levels_of(TomlSection& own, const Disturbance& one) {
  if (!own.has(one.key)) return {};
  const toml::node* list = own.node(one.key);
  auto levels = own.numbers(*list, own.name_of(one.key)).value_or(std::vector<double>{});
  if (levels.empty()) {
    own.refuse(one.key, fmt::format("'{}' holds no level", own.name_of(one.key)),
               fmt::format("give some, in {}", one.unit[0] == '\0' ? "counts" : one.unit));
  }
  return levels;
}

/// One sweep, in which one disturbance after the other takes its levels and all others are as in
/// [bench].
void read(TomlSection& own, StudyConfig& study) {
  need_truths(own, study);
  study.settings.numbers["error_percent"] = percent_of(own, "error", 5.0);
  SweepAxis sweep{"robustness", {}, {}};
  std::vector<SweepValue> undisturbed;
  std::vector<const Disturbance*> disturbed;
  std::vector<std::vector<double>> levels;
  for (const Disturbance& one : kDisturbances) {
    auto list = levels_of(own, one);
    if (list.empty()) continue;
    sweep.keys.push_back({fmt::format("bench.{}", one.key), one.unit});
    undisturbed.push_back(value_of(one, one.value(study.bench)));
    disturbed.push_back(&one);
    levels.push_back(std::move(list));
  }
  if (disturbed.empty()) {
    return own.refuse("", "a study of kind robustness has no disturbance",
                      "add levels, e.g. [robustness] angle_noise = [0.1, 0.5, 2.0]");
  }
  sweep.points.push_back(undisturbed);
  for (std::size_t d = 0; d < disturbed.size(); ++d) {
    study.settings.names["disturbances"].push_back(disturbed[d]->key);
    for (const double level : levels[d]) {
      study.settings.lists["of_point"].push_back(static_cast<double>(d));
      study.settings.lists["level"].push_back(level);
      sweep.points.push_back(undisturbed);
      sweep.points.back()[d] = value_of(*disturbed[d], level);
    }
  }
  study.sweeps.push_back(std::move(sweep));
}

const std::pair<const char*, const char*> kErrors[] = {{"holdout_median_percent", "torque"},
                                                       {"error_f_percent", "f"},
                                                       {"error_g_inverse_percent", "g^-1"},
                                                       {"error_h_percent", "h"}};

/// The first level, from the mildest on, at which a line passes the limit, between its neighbours
/// by a straight line over the logarithms where both are positive. NaN where it never does.
double breaks_at(const std::map<double, std::vector<double>>& line, double limit, bool falling) {
  std::vector<std::pair<double, double>> points;
  for (const auto& [level, values] : line) points.emplace_back(level, middle_of(values));
  if (falling) std::ranges::reverse(points);
  // What is nowhere is no part of the estimate.
  if (std::ranges::all_of(points, [](const auto& one) { return std::isnan(one.second); })) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto [x, y] = points[i];
    if (std::isnan(y)) return x;  // nothing came of it any more
    if (y <= limit) continue;
    if (i == 0) return x;
    const auto [x0, y0] = points[i - 1];
    const double u = (limit - y0) / (y - y0);
    return x > 0.0 && x0 > 0.0 ? x0 * std::pow(x / x0, u) : x0 + u * (x - x0);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

KindAnswer answer(const StudyRows& rows) {
  const StudyConfig& study = rows.study();
  const auto& names = study.settings.names.at("disturbances");
  const auto& of_point = study.settings.lists.at("of_point");
  const auto& level = study.settings.lists.at("level");
  const double limit = study.settings.numbers.at("error_percent");
  // [disturbance][error] -> estimator -> level -> errors; the undisturbed bench is in none of them.
  std::vector<std::vector<Gathered>> found(names.size(), std::vector<Gathered>(std::size(kErrors)));
  rows.each([&](const CasePlan& one, const CaseRow& row) {
    const std::size_t point = point_of(study, one.variant).back();
    if (point == 0) return;
    const auto d = static_cast<std::size_t>(of_point[point - 1]);
    for (std::size_t e = 0; e < std::size(kErrors); ++e) {
      found[d][e][one.estimator->id][level[point - 1]].push_back(row.number(kErrors[e].first));
    }
  });
  KindAnswer answer;
  AnswerTable table{"breaks",
                    fmt::format("Where the median error passes {:g} %; a dash: nowhere in "
                                "the levels tried",
                                limit),
                    {"disturbance", "estimator"},
                    {}};
  for (const auto& [number, name] : kErrors)
    table.columns.push_back(std::string("error of ") + name);
  for (std::size_t d = 0; d < names.size(); ++d) {
    AnswerFigure figure{"robustness-" + names[d],
                        fmt::format("Errors over {}", names[d]),
                        "Median over inputs and replicates; everything else as in [bench].",
                        "",
                        {}};
    std::ranges::replace(figure.id, '_', '-');
    const std::string unit = study.sweeps.back().keys[d].unit;
    for (std::size_t e = 0; e < std::size(kErrors); ++e) {
      AnswerPanel panel = lines_of(found[d][e], names[d] + (unit.empty() ? "" : " / " + unit),
                                   fmt::format("error of {} / %", kErrors[e].second));
      panel.title = kErrors[e].second;
      if (std::ranges::any_of(panel.series, [](const auto& s) { return !s.x.empty(); })) {
        figure.panels.push_back(std::move(panel));
      }
    }
    answer.figures.push_back(std::move(figure));
    const bool falling = names[d] == "samples_per_cycle";
    for (const auto& [estimator, line] : found[d][0]) {
      auto& cells = table.rows.emplace_back();
      cells = {names[d], estimator};
      for (std::size_t e = 0; e < std::size(kErrors); ++e) {
        cells.emplace_back(breaks_at(found[d][e][estimator], limit, falling));
      }
      const double breaks = std::get<double>(cells[2]);
      if (std::isnan(breaks)) continue;
      answer.says += fmt::format("{}{} passes {:g} % of held-out torque error at {} = {:.3g}{}",
                                 answer.says.empty() ? "" : "; ", estimator, limit, names[d],
                                 breaks, unit.empty() ? "" : " " + unit);
    }
  }
  if (answer.says.empty()) {
    answer.says = fmt::format(
        "No estimator passes {:g} % of held-out torque error at any level tried", limit);
  }
  answer.says += ".";
  answer.tables.push_back(std::move(table));
  return answer;
}

}  // namespace

KindRow describe_robustness() {
  return {.id = "robustness",
          .summary = "noise, its colour, quantisation, sampling, jitter and gaps, one at a time",
          .cases = "inputs x estimators x replicates x levels of every disturbance",
          .question = "Where does each method break?",
          .read = read,
          .answer = answer};
}

}  // namespace flexspline::studies
