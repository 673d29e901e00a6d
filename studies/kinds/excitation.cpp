#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include <fmt/format.h>

#include "answers/kind_tables.hpp"
#include "comparison/middle_of.hpp"
#include "flexspline/studies/kind.hpp"
#include "flexspline/studies/study_rows.hpp"

namespace flexspline::studies {
namespace {

constexpr std::string_view kBase = "recorded";
constexpr std::string_view kWith = "with-";

double speed_of(const Loop& loop) {
  return 2.0 * std::numbers::pi * loop.frequency_hz * loop.amplitude;
}

/// Estimators on what is recorded already, and on that with one candidate more.
void read(TomlSection& own, StudyConfig& study) {
  need_truths(own, study);
  const Grid* candidates = named_grid(own, "candidates", study);
  const Grid* base = named_grid(own, "recorded", study);
  const auto speed = own.quantity("largest_speed", Dimension::angular_velocity, 0.0);
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

std::vector<double> sorted_once(std::vector<double> values) {
  const std::set<double> once(values.begin(), values.end());
  return {once.begin(), once.end()};
}

/// log2 of how much narrower a band becomes: bits a candidate is expected to tell of a function.
double bits(const std::map<std::string, std::vector<double>>& by_suffix, const std::string& with) {
  const auto base = by_suffix.find(std::string(kBase));
  const auto other = by_suffix.find(with);
  if (other == by_suffix.end()) return std::numeric_limits<double>::quiet_NaN();
  // A function that was not identified before is told of by whatever identifies it.
  if (base == by_suffix.end()) return std::numeric_limits<double>::quiet_NaN();
  return std::log2(middle_of(base->second) / middle_of(other->second));
}

KindAnswer answer(const StudyRows& rows) {
  const StudyConfig& study = rows.study();
  const auto& amplitude = study.settings.lists.at("amplitude");
  const auto& frequency = study.settings.lists.at("frequency");
  const auto amplitudes = sorted_once(amplitude);
  const auto frequencies = sorted_once(frequency);
  Widths widths;
  rows.each([&](const CasePlan& one, const CaseRow& row) {
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
      AnswerPanel panel;
      panel.title = function + ", " + estimator;
      panel.x_label = "frequency / Hz";
      panel.y_label = "amplitude / deg";
      for (const double f : frequencies) panel.x_names.push_back(fmt::format("{:g}", f));
      const double degrees = 180.0 / std::numbers::pi;
      for (const double a : amplitudes) panel.y_names.push_back(fmt::format("{:.3g}", degrees * a));
      panel.cells.assign(
          amplitudes.size(),
          std::vector<double>(frequencies.size(), std::numeric_limits<double>::quiet_NaN()));
      std::size_t best = amplitude.size();
      double most = -std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < amplitude.size(); ++k) {
        const std::string with = fmt::format("{}{}", kWith, k + 1);
        const double gain = bits(by_suffix, with);
        if (std::isnan(gain)) continue;
        const auto a = std::ranges::lower_bound(amplitudes, amplitude[k]) - amplitudes.begin();
        const auto f = std::ranges::lower_bound(frequencies, frequency[k]) - frequencies.begin();
        panel.cells[static_cast<std::size_t>(a)][static_cast<std::size_t>(f)] = gain;
        table.rows.push_back({estimator, function, degrees * amplitude[k], frequency[k], gain,
                              middle_of(by_suffix.at(with))});
        if (gain > most) most = gain, best = k;
      }
      if (best == amplitude.size()) continue;
      figure.panels.push_back(std::move(panel));
      answer.says += fmt::format("{}for {} ({}) record {:.3g} deg at {:g} Hz: {:.2g} bits",
                                 answer.says.empty() ? "Next, " : "; ", function, estimator,
                                 degrees * amplitude[best], frequency[best], most);
    }
  }
  answer.says = answer.says.empty()
                    ? "No candidate can be judged: what is recorded identifies no function."
                    : answer.says + ".";
  answer.figures.push_back(std::move(figure));
  answer.tables.push_back(std::move(table));
  return answer;
}

}  // namespace

KindRow describe_excitation() {
  return {.id = "excitation",
          .summary = "what one recording more would tell of f, g^-1 and h, within a rig's limits",
          .cases = "inputs x estimators x (what is recorded, and with each candidate) x replicates",
          .question = "Which recording should be taken next?",
          .read = read,
          .answer = answer,
          .chooses_training = true};
}

}  // namespace flexspline::studies
