#include <algorithm>
#include <cmath>
#include <functional>

#include "flexspline/studies/trial.hpp"
#include "trial/median.hpp"

namespace flexspline::studies {
namespace {

using Counts = std::function<bool(const CaseScore&)>;

int count(const std::vector<ScoredCase>& cases, const Counts& counts) {
  return static_cast<int>(
      std::ranges::count_if(cases, [&counts](const ScoredCase& one) { return counts(one.score); }));
}

int sum(const std::vector<ScoredCase>& cases, const std::function<int(const CaseScore&)>& of) {
  int total = 0;
  for (const ScoredCase& one : cases) total += of(one.score);
  return total;
}

int unnamed(const std::vector<ScoredCase>& cases, CaseKind kind) {
  return count(cases, [kind](const CaseScore& score) {
    return score.kind == kind && !score.failed && score.named == 0;
  });
}

int with_alternatives(const std::vector<ScoredCase>& cases, bool NameScore::*member) {
  return count(cases, [member](const CaseScore& score) { return score.with_alternatives.*member; });
}

Counts is(CaseKind kind) {
  return [kind](const CaseScore& score) { return score.kind == kind; };
}

void add_counters(const std::vector<ScoredCase>& cases, TrialScores& scores) {
  const auto add = [&](const char* name, int value) { scores.counters.emplace_back(name, value); };
  const auto add_if = [&](const char* name, auto member) {
    add(name, count(cases, [member](const CaseScore& score) { return score.*member; }));
  };
  add("cases", static_cast<int>(cases.size()));
  add_if("failed", &CaseScore::failed);
  add("null", count(cases, is(CaseKind::null)));
  add_if("null_ok", &CaseScore::null_right);
  add("single", count(cases, is(CaseKind::single)));
  add_if("single_top", &CaseScore::first_right);
  add_if("single_exact", &CaseScore::exact);
  add("pair", count(cases, is(CaseKind::pair)));
  add_if("pair_all", &CaseScore::pair_both);
  add_if("pair_one", &CaseScore::pair_one);
  add("unknown", count(cases, is(CaseKind::unknown)));
  add("unknown_ok", count(cases, [](const CaseScore& score) {
        return score.kind == CaseKind::unknown && score.unknown_right;
      }));
  add("unknown_unnamed", unnamed(cases, CaseKind::unknown));
  add("contained", count(cases, is(CaseKind::contained)));
  add_if("contained_ok", &CaseScore::contained_right);
  add("incident", count(cases, is(CaseKind::incident)));
  add_if("incident_ok", &CaseScore::incident_found);
  add("incident_unnamed", unnamed(cases, CaseKind::incident));
  add("single_exact_or_alternative", with_alternatives(cases, &NameScore::exact));
  add("pair_all_or_alternative", with_alternatives(cases, &NameScore::pair_both));
  add("contained_ok_or_alternative", with_alternatives(cases, &NameScore::contained_right));
  add("false_names", sum(cases, [](const CaseScore& score) { return score.false_names; }));
  add("false_names_and_alternatives",
      sum(cases, [](const CaseScore& score) { return score.with_alternatives.false_names; }));
  add("named", sum(cases, [](const CaseScore& score) { return score.named; }));
  add_if("coord", &CaseScore::has_coordinate);
  add_if("coord_ok", &CaseScore::located);
}

void add_rates(const std::vector<ScoredCase>& cases, TrialScores& scores) {
  const auto add = [&](const char* name, const char* part, const char* whole) {
    scores.rates.emplace_back(name, proportion(scores.counter(part), scores.counter(whole)));
  };
  add("null_ok", "null_ok", "null");
  add("single_top", "single_top", "single");
  add("single_exact", "single_exact", "single");
  add("pair_all", "pair_all", "pair");
  add("pair_one", "pair_one", "pair");
  add("unknown_ok", "unknown_ok", "unknown");
  add("unknown_unnamed", "unknown_unnamed", "unknown");
  add("contained_ok", "contained_ok", "contained");
  add("incident_ok", "incident_ok", "incident");
  add("incident_unnamed", "incident_unnamed", "incident");
  add("single_exact_or_alternative", "single_exact_or_alternative", "single");
  add("pair_all_or_alternative", "pair_all_or_alternative", "pair");
  add("contained_ok_or_alternative", "contained_ok_or_alternative", "contained");
  add("coord_ok", "coord_ok", "coord");
  const int falsely = count(cases, [](const CaseScore& score) { return score.false_names > 0; });
  const int diagnosed = count(cases, [](const CaseScore& score) {
    return !score.failed && score.kind != CaseKind::kept && score.kind != CaseKind::spliced;
  });
  scores.rates.emplace_back("false_name", proportion(falsely, diagnosed));
  const int beside =
      count(cases, [](const CaseScore& score) { return score.with_alternatives.false_names > 0; });
  scores.rates.emplace_back("false_name_and_alternatives", proportion(beside, diagnosed));
}

/// Where there are locked rigs, of these alone: there the effort is one sensor's, whose noise is
/// known, and practice cases are scored so.
double median_over(const std::vector<ScoredCase>& cases, double CaseScore::*member) {
  const auto locked = [](const ScoredCase& one) { return one.answer.rig.rig == Rig::locked; };
  const bool any = std::ranges::any_of(cases, locked);
  std::vector<double> values;
  for (const ScoredCase& one : cases) {
    if (!any || locked(one)) values.push_back(one.score.*member);
  }
  return median_of(std::move(values));
}

void add_medians(const std::vector<ScoredCase>& cases, TrialScores& scores) {
  std::vector<double> seconds;
  for (const ScoredCase& one : cases) {
    if (std::isfinite(one.seconds)) seconds.push_back(one.seconds);
  }
  scores.medians = {
      {"holdout_after_over_noise_median", median_over(cases, &CaseScore::after_over_noise)},
      {"holdout_after_over_best_median", median_over(cases, &CaseScore::after_over_best)},
      {"gain_share_median", median_over(cases, &CaseScore::gain_share)},
      {"seconds_median", median_of(seconds)},
      {"seconds_max", seconds.empty() ? kNotComputed : *std::ranges::max_element(seconds)}};
}

template <class Value>
Value find(const std::vector<std::pair<std::string, Value>>& list, std::string_view name) {
  const auto found = std::ranges::find(list, name, &std::pair<std::string, Value>::first);
  expects(found != list.end(), "a score of this name is counted");
  return found->second;
}

}  // namespace

int TrialScores::counter(std::string_view name) const { return find(counters, name); }
Proportion TrialScores::rate(std::string_view name) const { return find(rates, name); }
double TrialScores::median(std::string_view name) const { return find(medians, name); }

TrialScores score_trial(const std::vector<ScoredCase>& cases) {
  TrialScores scores;
  add_counters(cases, scores);
  add_rates(cases, scores);
  add_medians(cases, scores);
  return scores;
}

}  // namespace flexspline::studies
