#include "trial/trial_json.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace flexspline::studies {
namespace {

using nlohmann::ordered_json;

ordered_json rate_json(const Proportion& one) {
  return {
      {"count", one.count}, {"of", one.of}, {"rate", one.rate()}, {"ci95", {one.lower, one.upper}}};
}

ordered_json scores_json(const TrialScores& scores) {
  ordered_json json = ordered_json::object();
  for (const auto& [name, value] : scores.counters) json[name] = value;
  for (const auto& [name, value] : scores.medians) {
    if (!name.starts_with("seconds")) json[name] = value;  // the same trial gives the same bytes
  }
  for (const auto& [name, one] : scores.rates) {
    json["rates"][name] = rate_json(one);
  }
  return json;
}

ordered_json case_json(const ScoredCase& one) {
  ordered_json json = {
      {"key", one.key},
      {"generator", one.answer.generator},
      {"disturbances", ordered_json::array()},
      {"rig", name_of(one.answer.rig)},
      {"effects", ordered_json::array()},
      {"size", ordered_json::array()},
      {"trace", ordered_json::array()},
      {"verdict", one.verdict},
      {"named", one.named},
      {"right", one.score.null_right || one.score.exact || one.score.pair_both ||
                    one.score.contained_right || one.score.incident_found ||
                    (one.score.kind == CaseKind::unknown && one.score.unknown_right)},
      {"after_over_noise", one.score.after_over_noise},
      {"failure", one.failure.empty() ? ordered_json(nullptr) : ordered_json(one.failure)}};
  for (const AppliedDisturbance& disturbance : one.answer.disturbances) {
    json["disturbances"].push_back(disturbance.id);
  }
  for (const data::HiddenFinding& effect : one.answer.effects) {
    json["effects"].push_back(effect.id);
    json["size"].push_back(effect.size_fraction);
    const auto trace = std::ranges::find(one.traces, effect.id, &EffectTrace::effect);
    json["trace"].push_back(trace == one.traces.end() ? kNotComputed : trace->share);
  }
  return json;
}

}  // namespace

ordered_json design_json(const TrialConfig& trial) {
  ordered_json rigs = ordered_json::array();
  for (const data::BenchKind rig : trial.rigs) rigs.push_back(name_of(rig));
  const ConcealDraw& draw = trial.draw;
  return {{"seed", trial.seed},
          {"cases", trial.cases},
          {"generators", trial.generators},
          {"rigs", rigs},
          {"none", draw.none},
          {"one", draw.one},
          {"two", draw.two},
          {"unknown", draw.unknown},
          {"contained", draw.contained},
          {"variant", draw.variant},
          {"incident", draw.incident},
          {"disturbed", draw.disturbed},
          {"size_fraction", {draw.smallest, draw.largest}},
          {"effects", draw.effects},
          {"nuisances", trial.nuisances},
          {"time_limit_s", trial.time_limit}};
}

namespace {

ordered_json twins_json(const TrialConfig& trial) {
  ordered_json list = ordered_json::array();
  for (const StructuralTwin& row : structural_twins()) {
    for (const Rig rig : row.rigs) {
      if (std::ranges::find(trial.rigs, rig) == trial.rigs.end()) continue;
      list.push_back({{"rig", name_of(rig)},
                      {"effect", row.effect},
                      {"twin", row.twin},
                      {"reason", row.reason}});
    }
  }
  return list;
}

ordered_json reliability_json(const std::vector<ScoredCase>& cases) {
  ordered_json list = ordered_json::array();
  for (const ReliabilityBin& bin : reliability_of(cases)) {
    list.push_back({{"from", bin.from},
                    {"to", bin.to},
                    {"mean_probability", bin.mean_probability},
                    {"right", rate_json(bin.right)}});
  }
  return list;
}

ordered_json splice_json(const SpliceScores& scores) {
  return {{"found_small", rate_json(scores.found_small)},
          {"found_large", rate_json(scores.found_large)},
          {"same_verdict", rate_json(scores.same_verdict)},
          {"names_shared", scores.names_shared},
          {"names_shared_decided", scores.names_shared_decided},
          {"changed", scores.changed},
          {"undecided", scores.undecided}};
}

/// What the answers are worth beside their names: printed probabilities, intervals, hold-outs.
void add_calibration(const std::vector<ScoredCase>& cases, ordered_json& json) {
  json["reliability"] = reliability_json(cases);
  json["coverage"] = ordered_json::object();
  for (const auto& [name, rate] : coverage_of(cases)) json["coverage"][name] = rate_json(rate);
  json["by_verdict"] = ordered_json::array();
  for (const VerdictError& one : errors_by_verdict(cases)) {
    json["by_verdict"].push_back({{"verdict", one.verdict},
                                  {"cases", one.count},
                                  {"holdout_over_noise_median", one.median}});
  }
  json["splices"] = splice_json(splice_scores(cases));
}

ordered_json bins_json(const std::vector<DetectionBin>& bins) {
  ordered_json list = ordered_json::array();
  for (const DetectionBin& bin : bins) {
    list.push_back({{"from", bin.from},
                    {"to", bin.to},
                    {"cases", bin.cases},
                    {"detected", bin.detected},
                    {"single_top", bin.first_right},
                    {"single_exact", bin.exact}});
  }
  return list;
}

void add_groups(const std::vector<ScoredCase>& cases, ordered_json& json) {
  json["by_size"] = bins_json(detection_by_size(cases));
  json["by_trace"] = bins_json(detection_by_trace(cases));
  json["by_effect"] = ordered_json::array();
  for (const auto& [group, some] : by_effect(cases)) {
    ordered_json row = scores_json(score_trial(some));
    json["by_effect"].push_back({{"rig", group.first}, {"effect", group.second}});
    for (const char* key : {"cases", "failed", "single_top", "single_exact", "coord", "coord_ok",
                            "holdout_after_over_noise_median"}) {
      json["by_effect"].back()[key] = row[key];
    }
  }
  json["confusion"] = ordered_json::array();
  for (const auto& [labels, count] : confusion_of(cases)) {
    json["confusion"].push_back(
        {{"truth", labels.first}, {"named", labels.second}, {"count", count}});
  }
}

}  // namespace

ordered_json trial_json(const TrialConfig& trial, const TrialSummary& summary,
                        const std::string& build_id) {
  ordered_json json = {{"schema", kTrialResultSchema},
                       {"name", trial.name},
                       {"title", trial.title},
                       {"build_id", build_id},
                       {"design", design_json(trial)},
                       {"scores", scores_json(score_trial(summary.cases))},
                       {"scores_seen", scores_json(score_trial(that_can_be_seen(summary.cases)))},
                       {"by_rig", ordered_json::object()}};
  for (const data::BenchKind rig : trial.rigs) {
    json["by_rig"][std::string(name_of(rig))] =
        scores_json(score_trial(of_rig(summary.cases, rig)));
  }
  for (const auto& [id, cases] : by_generator(summary.cases)) {
    json["by_generator"][id] = scores_json(score_trial(cases));
  }
  json["by_disturbance"] = ordered_json::object();
  for (const auto& [id, cases] : by_disturbance(summary.cases)) {
    json["by_disturbance"][id] = scores_json(score_trial(cases));
  }
  add_calibration(summary.cases, json);
  add_groups(summary.cases, json);
  json["twins"] = twins_json(trial);
  json["not_concealed"] = summary.not_concealed;
  json["cases"] = ordered_json::array();
  for (const ScoredCase& one : summary.cases) json["cases"].push_back(case_json(one));
  return json;
}

}  // namespace flexspline::studies
