#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "answers/cause_discrimination.hpp"
#include "answers/kind_parts.hpp"
#include "answers/kind_tables.hpp"
#include "comparison/middle_of.hpp"
#include "flexspline/core/nearest_name.hpp"
#include "flexspline/studies/kind.hpp"
#include "flexspline/studies/study_rows.hpp"

namespace flexspline::studies {
namespace {

constexpr std::string_view kBase = "recorded";
constexpr std::string_view kWith = "with-";

double speed_of(const Loop& loop) {
  return 2.0 * std::numbers::pi * loop.frequency_hz * loop.amplitude;
}

/// The two estimators whose models are alternative causes; none where it is not asked.
void read_causes(TomlSection& own, StudyConfig& study) {
  if (!own.has("discriminate")) return;
  const std::vector<std::string> causes = own.texts("discriminate");
  std::vector<std::string_view> known;
  for (const EstimatorConfig& one : study.estimators) {
    if (one.model) known.emplace_back(one.id);
  }
  if (causes.size() != 2 || causes[0] == causes[1]) {
    return own.refuse("discriminate", "two causes are compared, no more and no less",
                      "name two estimators with a model, discriminate = [\"a\", \"b\"]");
  }
  for (const std::string& id : causes) {
    if (std::ranges::find(known, id) != known.end()) continue;
    own.refuse("discriminate", fmt::format("there is no estimator '{}' with a model", id),
               suggestion(id, known));
  }
  study.settings.names["discriminate"] = causes;
}

/// Estimators on what is recorded already, and on that with one candidate more.
void read(TomlSection& own, StudyConfig& study) {
  need_truths(own, study);
  const Grid* candidates = named_grid(own, "candidates", study);
  const Grid* base = named_grid(own, "recorded", study);
  const auto speed = own.quantity("largest_speed", Dimension::angular_velocity, 0.0);
  read_causes(own, study);
  if (candidates == nullptr || base == nullptr) return;
  const std::vector<Loop> recorded = base->loops;
  std::vector<Loop> added;
  for (const Loop& loop : candidates->loops) {
    const bool allowed = !speed || speed_of(loop) <= *speed;
    if (allowed && std::ranges::find(recorded, loop) == recorded.end()) added.push_back(loop);
  }
  if (added.empty()) {
    return own.refuse("candidates",
                      fmt::format("grid '{}' holds no loop that the rig's limits allow "
                                  "and that is not recorded already",
                                  candidates->id),
                      "add loops, or raise largest_speed");
  }
  const std::string base_id = base->id;
  hold_out_everywhere(study, candidates->id);
  std::vector<EstimatorConfig> made;
  const auto add = [&](const std::string& suffix, const std::string& grid) {
    for (const EstimatorConfig& written : study.estimators) {
      made.push_back(made_from(written, suffix));
      made.back().train = grid;
    }
  };
  add(std::string(kBase), base_id);
  for (std::size_t k = 0; k < added.size(); ++k) {
    Grid with{fmt::format("{}{}", kWith, k + 1), recorded};
    with.loops.push_back(added[k]);
    add(with.id, with.id);
    study.settings.lists["amplitude"].push_back(added[k].amplitude);
    study.settings.lists["frequency"].push_back(added[k].frequency_hz);
    study.grids.push_back(std::move(with));
  }
  study.estimators = std::move(made);
}

const std::pair<const char*, const char*> kFunctions[] = {
    {"width_f_percent", "f"}, {"width_g_inverse_percent", "g^-1"}, {"width_h_percent", "h"}};

/// Widths of bands: [estimator as written][function][suffix] over inputs and replicates.
using Widths =
    std::map<std::string, std::map<std::string, std::map<std::string, std::vector<double>>>>;

/// log2 of how much narrower a band becomes: bits a candidate is expected to tell of a function.
double bits(const std::map<std::string, std::vector<double>>& by_suffix, const std::string& with) {
  const auto base = by_suffix.find(std::string(kBase));
  const auto other = by_suffix.find(with);
  if (other == by_suffix.end()) return std::numeric_limits<double>::quiet_NaN();
  // A function that was not identified before is told of by whatever identifies it.
  if (base == by_suffix.end()) return std::numeric_limits<double>::quiet_NaN();
  return std::log2(middle_of(base->second) / middle_of(other->second));
}

std::vector<Loop> candidates_of(const StudyConfig& study) {
  const auto& amplitude = study.settings.lists.at("amplitude");
  const auto& frequency = study.settings.lists.at("frequency");
  std::vector<Loop> loops;
  for (std::size_t k = 0; k < amplitude.size(); ++k) loops.push_back({amplitude[k], frequency[k]});
  return loops;
}

KindAnswer answer(const StudyRows& rows) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  const std::vector<Loop> candidates = candidates_of(rows.study());
  std::vector<std::string> suffixes;
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    suffixes.push_back(fmt::format("{}{}", kWith, k + 1));
  }
  const auto& names = rows.study().settings.names;
  const auto causes = names.find("discriminate");
  Widths widths;
  rows.each([&](const CasePlan& one, const CaseRow& row) {
    // Of an alternative cause the bands say nothing: one of the two models is wrong.
    if (causes != names.end() && std::ranges::count(causes->second, one.estimator->written_id())) {
      return;
    }
    const std::string suffix = one.estimator->id.substr(one.estimator->written_id().size() + 1);
    for (const auto& [number, function] : kFunctions) {
      const double width = row.number(number);
      if (!std::isnan(width))
        widths[one.estimator->written_id()][function][suffix].push_back(width);
    }
  });
  KindAnswer answer;
  AnswerFigure figure{"excitation",
                      "How much narrower the bands become by one recording more",
                      "log2 of the median width of a band without the candidate over that with it; "
                      "1: half as wide.",
                      "bits",
                      {}};
  AnswerTable table{"excitation",
                    "Expected information of one recording more",
                    {"estimator", "function", "amplitude / deg", "frequency / Hz", "bits",
                     "width with it / % of the largest value"},
                    {}};
  for (const auto& [estimator, by_function] : widths) {
    for (const auto& [function, by_suffix] : by_function) {
      std::vector<double> gains;
      std::size_t best = candidates.size();
      for (std::size_t k = 0; k < candidates.size(); ++k) {
        gains.push_back(bits(by_suffix, suffixes[k]));
        if (std::isnan(gains[k])) continue;
        table.rows.push_back({estimator, function, kDegrees * candidates[k].amplitude,
                              candidates[k].frequency_hz, gains[k],
                              middle_of(by_suffix.at(suffixes[k]))});
        if (best == candidates.size() || gains[k] > gains[best]) best = k;
      }
      if (best == candidates.size()) continue;
      figure.panels.push_back(loop_cells(function + ", " + estimator, candidates, gains));
      answer.says += fmt::format("{}for {} ({}) record {:.3g} deg at {:g} Hz: {:.2g} bits",
                                 answer.says.empty() ? "Next, " : "; ", function, estimator,
                                 kDegrees * candidates[best].amplitude,
                                 candidates[best].frequency_hz, gains[best]);
    }
  }
  if (causes != names.end()) {
    add_discrimination(rows, causes->second, std::string(kBase), suffixes, candidates, answer);
  }
  answer.says = answer.says.empty()
                    ? "No candidate can be judged: what is recorded identifies no function."
                    : answer.says + ".";
  if (!figure.panels.empty()) answer.figures.push_back(std::move(figure));
  if (!table.rows.empty()) answer.tables.push_back(std::move(table));
  return answer;
}

}  // namespace

KindRow describe_excitation() {
  return {
      .id = "excitation",
      .summary =
          "what one recording more would tell of f, g^-1 and h, or of which of two causes it is",
      .cases = "inputs x estimators x (what is recorded, and with each candidate) x replicates",
      .question = "Which recording should be taken next?",
      .read = read,
      .answer = answer,
      .chooses_training = true};
}

}  // namespace flexspline::studies
