#include <cmath>

#include "figures/trial_figures.hpp"
#include "numbers.hpp"

namespace flexspline::reports {
namespace {

std::string share_of(const ShownRate& rate) {
  return compact(rate.count, 6) + " of " + compact(rate.of, 6) +
         " (95 %: " + digits(100.0 * rate.lower, 3) + " to " + digits(100.0 * rate.upper, 3) +
         " %)";
}

std::string sentence_of(const TrialView& view) {
  const double cases = view.scores.number("cases");
  std::string text =
      "Of " + compact(std::isfinite(cases) ? cases : static_cast<double>(view.cases.size()), 6) +
      " concealed cases";
  const auto add = [&](const char* name, const char* before, const char* after) {
    const ShownRate rate = view.scores.rate(name);
    if (rate.of > 0.0) text += std::string(before) + share_of(rate) + after;
  };
  add("null_ok", ", those that hid nothing were called adequate in ", "");
  add("single_exact", "; a single effect was named, and nothing else, in ", "");
  add("unknown_unnamed", "; what no catalogue has was given no name in ", "");
  add("false_name", "; a false name was given in ", "");
  return text + ".";
}

Table rates_table(const TrialView& view) {
  Table table{"trial-rates",
              "What the trial was to show, with exact 95 % intervals. An effect can be seen where "
              "the baseline, fitted to the recordings, leaves as much of it as a diagnosis names "
              "at least; what f and g⁻¹ absorb cannot be named.",
              {{"question", "", 3},
               {"cases", "", 0},
               {"of", "", 0},
               {"share", "%", 3},
               {"from", "%", 3},
               {"to (95 %)", "%", 3},
               {"that can be seen", "", 0},
               {"of", "", 0},
               {"share", "%", 3}},
              {}};
  for (const auto& [name, rate] : told_rates(view.scores)) {
    const ShownRate seen = view.scores_seen.rate(name);
    table.rows.push_back({rate_title(name), rate.count, rate.of, 100.0 * rate.rate,
                          100.0 * rate.lower, 100.0 * rate.upper, seen.count, seen.of,
                          100.0 * seen.rate});
  }
  return table;
}

struct Number {
  const char* name;
  const char* title;
};

constexpr Number kNumbers[] = {
    {"cases", "cases"},
    {"failed", "diagnoses that failed"},
    {"named", "names given"},
    {"false_names", "names that were false"},
    {"holdout_after_over_noise_median", "hold-out over the noise, median of named cases"},
    {"holdout_after_over_best_median", "hold-out over what the true drive leaves, median"},
    {"gain_share_median", "share of the possible gain, median"},
    {"seconds_median", "seconds a diagnosis, median"},
    {"seconds_max", "seconds a diagnosis, longest"}};

/// Counts as they are, medians to three digits.
double told(double value) { return value == std::round(value) ? value : rounded(value, 3); }

Table numbers_table(const TrialView& view) {
  Table table{"trial-scores",
              "The other scores, over all cases and by rig.",
              {{"score", "", 3}, {"all", "", 0}},
              {}};
  for (const auto& [rig, scores] : view.by_rig) table.columns.push_back({rig, "", 0});
  for (const Number& one : kNumbers) {
    std::vector<Cell> row{one.title, told(view.scores.number(one.name))};
    for (const auto& [rig, scores] : view.by_rig) row.emplace_back(told(scores.number(one.name)));
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::optional<Section> draw(const TrialView& view) {
  Section section{"verdict", "In short", {}};
  section.add(Verdict{sentence_of(view)});
  if (Figure figure = rates_figure(view); !figure.frames.empty()) section.add(std::move(figure));
  section.add(rates_table(view));
  section.add(numbers_table(view));
  return section;
}

}  // namespace

TrialSectionRow describe_trial_verdict() { return {0, draw}; }

}  // namespace flexspline::reports
