#include <cmath>

#include <nlohmann/json.hpp>

#include "json_fields.hpp"
#include "parse_artefacts.hpp"

namespace flexspline::reports {
namespace {

using nlohmann::json;

/// A count; none where the artefact has none.
double count_in(const json& from, const char* key) {
  const double value = number_in(from, key);
  return std::isfinite(value) ? value : 0.0;
}

ShownRate parse_rate(const json& from) {
  const std::vector<double> interval = numbers_in(from, "ci95");
  const bool whole = interval.size() == 2;
  return {count_in(from, "count"), count_in(from, "of"), number_in(from, "rate"),
          whole ? interval[0] : kAbsent, whole ? interval[1] : kAbsent};
}

ShownScores parse_scores(const json& from) {
  ShownScores scores;
  for (const auto& item : from.items()) {
    if (item.value().is_number()) scores.numbers[item.key()] = item.value().get<double>();
  }
  for (const auto& item : member(from, "rates").items()) {
    scores.rates[item.key()] = parse_rate(item.value());
  }
  return scores;
}

ShownDetectionBin parse_bin(const json& from) {
  return {number_in(from, "from"),    number_in(from, "to"),        count_in(from, "cases"),
          count_in(from, "detected"), count_in(from, "single_top"), count_in(from, "single_exact")};
}

ShownEffectScore parse_effect(const json& from) {
  return {text_in(from, "rig"),
          text_in(from, "effect"),
          count_in(from, "cases"),
          count_in(from, "failed"),
          count_in(from, "single_top"),
          count_in(from, "single_exact"),
          count_in(from, "coord"),
          count_in(from, "coord_ok"),
          number_in(from, "holdout_after_over_noise_median")};
}

void parse_groups(const json& from, std::map<std::string, ShownScores>& groups) {
  for (const auto& item : from.items()) groups[item.key()] = parse_scores(item.value());
}

void parse_calibration(const json& artefact, TrialView& view) {
  for (const json& one : member(artefact, "reliability")) {
    view.reliability.push_back({number_in(one, "from"), number_in(one, "to"),
                                number_in(one, "mean_probability"),
                                parse_rate(member(one, "right"))});
  }
  for (const auto& item : member(artefact, "coverage").items()) {
    view.coverage[item.key()] = parse_rate(item.value());
  }
  for (const json& one : member(artefact, "by_verdict")) {
    view.by_verdict.push_back({text_in(one, "verdict"), count_in(one, "cases"),
                               number_in(one, "holdout_over_noise_median")});
  }
  const json& splices = member(artefact, "splices");
  view.splices = {parse_rate(member(splices, "found_small")),
                  parse_rate(member(splices, "found_large")),
                  parse_rate(member(splices, "same_verdict")), number_in(splices, "names_shared")};
}

ShownTrialCase parse_case_of_trial(const json& from) {
  ShownTrialCase one;
  one.key = text_in(from, "key");
  one.rig = text_in(from, "rig");
  one.verdict = text_in(from, "verdict");
  one.failure = text_in(from, "failure");
  one.effects = texts_in(from, "effects");
  one.named = texts_in(from, "named");
  one.size = numbers_in(from, "size");
  one.trace = numbers_in(from, "trace");
  one.right = flag_in(from, "right");
  one.after_over_noise = number_in(from, "after_over_noise");
  one.seconds = number_in(from, "seconds");
  return one;
}

}  // namespace

double ShownScores::number(const std::string& name) const {
  const auto found = numbers.find(name);
  return found == numbers.end() ? kAbsent : found->second;
}

ShownRate ShownScores::rate(const std::string& name) const {
  const auto found = rates.find(name);
  return found == rates.end() ? ShownRate{} : found->second;
}

TrialView parse_trial(const json& artefact) {
  TrialView view;
  view.name = text_in(artefact, "name");
  view.title = text_in(artefact, "title");
  view.build_id = text_in(artefact, "build_id");
  view.design = member(artefact, "design").dump(2, ' ', false, json::error_handler_t::replace);
  view.scores = parse_scores(member(artefact, "scores"));
  view.scores_seen = parse_scores(member(artefact, "scores_seen"));
  parse_groups(member(artefact, "by_rig"), view.by_rig);
  parse_groups(member(artefact, "by_generator"), view.by_generator);
  parse_groups(member(artefact, "by_disturbance"), view.by_disturbance);
  parse_calibration(artefact, view);
  for (const json& one : member(artefact, "by_size")) view.by_size.push_back(parse_bin(one));
  for (const json& one : member(artefact, "by_trace")) view.by_trace.push_back(parse_bin(one));
  for (const json& one : member(artefact, "by_effect")) {
    view.by_effect.push_back(parse_effect(one));
  }
  for (const json& one : member(artefact, "confusion")) {
    view.confusion.push_back(
        {text_in(one, "truth"), text_in(one, "named"), count_in(one, "count")});
  }
  for (const json& one : member(artefact, "twins")) {
    view.twins.push_back({text_in(one, "rig"), text_in(one, "effect"), text_in(one, "twin"),
                          text_in(one, "reason")});
  }
  view.not_concealed = texts_in(artefact, "not_concealed");
  for (const json& one : member(artefact, "cases")) view.cases.push_back(parse_case_of_trial(one));
  return view;
}

}  // namespace flexspline::reports
