#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "trial/trial_json.hpp"

namespace flexspline::studies {
namespace {

using nlohmann::ordered_json;

ordered_json cause_json(const Cause& cause) {
  return {{"effect", cause.effect},
          {"probability", cause.probability},
          {"size_fraction", cause.size_fraction},
          {"stability", cause.stability},
          {"alternatives", cause.alternatives},
          {"score_p_value", cause.evidence.score_p_value},
          {"holdout_rmse_ratio", cause.evidence.holdout_rmse_ratio},
          {"delta_bic", cause.evidence.delta_bic},
          {"over_noise", cause.evidence.over_noise},
          {"before_over_noise", cause.evidence.before_over_noise},
          {"left_over", cause.evidence.left_over}};
}

ordered_json unnamed_json(const UnnamedPart& part) {
  ordered_json coordinates = ordered_json::array();
  for (const TableAxis& axis : part.axes) coordinates.push_back(axis.coordinate);
  return {{"coordinates", std::move(coordinates)},
          {"equation", part.equation},
          {"evidence", part.evidence},
          {"size_fraction", part.size_fraction},
          {"share", part.share},
          {"holdout_ratio", part.holdout_ratio},
          {"ci95", {part.ci95_lower, part.ci95_upper}},
          {"proposed_equation", part.proposed_equation}};
}

ordered_json mismatch_json(const Mismatch& mismatch) {
  return {{"recording", mismatch.recording},
          {"coordinate", mismatch.coordinate},
          {"equation", mismatch.equation},
          {"share_of_excess", mismatch.share_of_excess},
          {"says", mismatch.says}};
}

double number(const ordered_json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_number() ? found->get<double>() : kNotComputed;
}

CaseKind kind_of(const std::string& name) {
  for (const CaseKind kind : {CaseKind::null, CaseKind::single, CaseKind::pair, CaseKind::contained,
                              CaseKind::incident, CaseKind::kept, CaseKind::spliced}) {
    if (name_of(kind) == name) return kind;
  }
  return CaseKind::unknown;
}

NameScore name_score_from_json(const ordered_json& json) {
  NameScore score;
  score.first_right = json.at("first_right").get<bool>();
  score.exact = json.at("exact").get<bool>();
  score.pair_both = json.at("pair_both").get<bool>();
  score.pair_one = json.at("pair_one").get<bool>();
  score.contained_right = json.at("contained_right").get<bool>();
  score.false_names = json.at("false_names").get<int>();
  return score;
}

ordered_json name_score_json(const NameScore& score) {
  return {{"first_right", score.first_right},
          {"exact", score.exact},
          {"pair_both", score.pair_both},
          {"pair_one", score.pair_one},
          {"contained_right", score.contained_right},
          {"false_names", score.false_names}};
}

ordered_json names_json(const std::vector<GivenName>& names) {
  ordered_json list = ordered_json::array();
  for (const GivenName& one : names) {
    list.push_back(
        {{"effect", one.effect}, {"right", one.right}, {"probability", one.probability}});
  }
  return list;
}

ordered_json intervals_json(const std::vector<GivenInterval>& intervals) {
  ordered_json list = ordered_json::array();
  for (const GivenInterval& one : intervals) {
    list.push_back(
        {{"parameter", one.parameter}, {"ci95", {one.lower, one.upper}}, {"truth", one.truth}});
  }
  return list;
}

CaseScore score_from_json(const ordered_json& json) {
  CaseScore score;
  static_cast<NameScore&>(score) = name_score_from_json(json);
  score.with_alternatives = name_score_from_json(json.at("with_alternatives"));
  for (const ordered_json& one : json.at("names")) {
    score.names.push_back({one.at("effect").get<std::string>(), one.at("right").get<bool>(),
                           number(one, "probability")});
  }
  for (const ordered_json& one : json.at("intervals")) {
    score.intervals.push_back({one.at("parameter").get<std::string>(),
                               one.at("ci95").at(0).get<double>(),
                               one.at("ci95").at(1).get<double>(), number(one, "truth")});
  }
  score.kind = kind_of(json.at("kind").get<std::string>());
  score.failed = json.at("failed").get<bool>();
  score.null_right = json.at("null_right").get<bool>();
  score.detected = json.at("detected").get<bool>();
  score.unknown_right = json.at("unknown_right").get<bool>();
  score.named = json.at("named").get<int>();
  score.has_coordinate = json.at("has_coordinate").get<bool>();
  score.located = json.at("located").get<bool>();
  score.first_name = json.at("first_name").get<std::string>();
  score.after_over_noise = number(json, "after_over_noise");
  score.after_over_best = number(json, "after_over_best");
  score.gain_share = number(json, "gain_share");
  score.incident_found = json.at("incident_found").get<bool>();
  score.overlap = number(json, "overlap");
  score.over_noise = number(json, "over_noise");
  return score;
}

}  // namespace

ordered_json excerpt_of(const Diagnosis& diagnosis) {
  ordered_json json = {{"verdict", name_of(diagnosis.verdict)},
                       {"says", diagnosis.says},
                       {"noise_std", diagnosis.noise_std},
                       {"causes", ordered_json::array()},
                       {"mismatch", ordered_json::array()},
                       {"tried", ordered_json::array()},
                       {"holdout",
                        {{"rmse_before", diagnosis.holdout.rmse_before},
                         {"rmse_after", diagnosis.holdout.rmse_after},
                         {"noise_floor", diagnosis.holdout.noise_floor}}},
                       {"notes", diagnosis.notes}};
  for (const Cause& cause : diagnosis.causes) json["causes"].push_back(cause_json(cause));
  if (diagnosis.unnamed) json["unnamed"] = unnamed_json(*diagnosis.unnamed);
  for (const Mismatch& mismatch : diagnosis.mismatch) {
    json["mismatch"].push_back(mismatch_json(mismatch));
  }
  for (const TriedCandidate& tried : diagnosis.tried) {
    json["tried"].push_back({{"effect", tried.effect},
                             {"round", tried.round},
                             {"misfit_removed", tried.misfit_removed},
                             {"delta_bic", tried.delta_bic},
                             {"holdout_rmse_ratio", tried.holdout_rmse_ratio},
                             {"outcome", tried.outcome}});
  }
  return json;
}

ordered_json to_json(const CaseScore& score) {
  ordered_json json = {{"kind", name_of(score.kind)}, {"failed", score.failed}};
  json.update(name_score_json(score));
  json.update({{"null_right", score.null_right},
               {"detected", score.detected},
               {"unknown_right", score.unknown_right},
               {"incident_found", score.incident_found},
               {"overlap", score.overlap},
               {"named", score.named},
               {"has_coordinate", score.has_coordinate},
               {"located", score.located},
               {"first_name", score.first_name},
               {"with_alternatives", name_score_json(score.with_alternatives)},
               {"names", names_json(score.names)},
               {"intervals", intervals_json(score.intervals)},
               {"over_noise", score.over_noise},
               {"after_over_noise", score.after_over_noise},
               {"after_over_best", score.after_over_best},
               {"gain_share", score.gain_share}});
  return json;
}

ordered_json to_json(const std::vector<EffectTrace>& traces) {
  ordered_json list = ordered_json::array();
  for (const EffectTrace& trace : traces) {
    list.push_back({{"effect", trace.effect}, {"share", trace.share}, {"sigma", trace.sigma}});
  }
  return list;
}

Result<ScoredCase> scored_case_from_json(const ordered_json& artefact) {
  try {
    ScoredCase one;
    one.key = artefact.at("key").get<std::string>();
    auto answer = answer_from_json(artefact.at("sealed").at("answer"));
    if (!answer) return tl::unexpected(answer.error());
    one.answer = *std::move(answer);
    one.score = score_from_json(artefact.at("score"));
    one.seconds = number(artefact, "seconds");
    for (const ordered_json& trace : artefact.at("trace")) {
      one.traces.push_back(
          {trace.at("effect").get<std::string>(), number(trace, "share"), number(trace, "sigma")});
    }
    one.verdict = "failed";
    if (artefact.at("failure").is_string()) one.failure = artefact.at("failure").get<std::string>();
    if (artefact.at("diagnosis").is_object() && !one.score.failed) {
      one.verdict = artefact["diagnosis"].at("verdict").get<std::string>();
      for (const ordered_json& cause : artefact["diagnosis"].at("causes")) {
        one.named.push_back(cause.at("effect").get<std::string>());
      }
    }
    return one;
  } catch (const nlohmann::json::exception& error) {
    return failure(ErrorCode::bad_data, fmt::format("not a trial's case: {}", error.what()),
                   "delete it and run the trial again");
  }
}

}  // namespace flexspline::studies
