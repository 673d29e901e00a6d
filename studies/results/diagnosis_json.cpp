#include "flexspline/studies/diagnosis_json.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

#include "flexspline/data/estimate_json.hpp"
#include "results/findings_json.hpp"

namespace flexspline::studies {
namespace {

using Json = nlohmann::ordered_json;

/// The library keeps NaN as a number until it is written; a reader of the object is to see null.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Unit unit_of(const std::string& symbol) {
  const auto unit = find_unit(symbol);
  expects(unit.has_value(), "a diagnosis is shown in units of units()");
  return *unit;
}

bool is_linear(const Diagnosis& diagnosis) {
  return unit_of(diagnosis.display.motion).dimension == Dimension::length;
}

Json shown(const std::vector<double>& values, const std::string& symbol) {
  const double factor = unit_of(symbol).factor;
  Json list = Json::array();
  for (const double value : values) list.push_back(number(value / factor));
  return list;
}

Json units_json(const Diagnosis& diagnosis) {
  return {{"motion", diagnosis.display.motion},
          {"rate", diagnosis.display.motion + "/s"},
          {"effort", diagnosis.display.effort},
          {"rmse", is_linear(diagnosis) ? "N" : "Nm"}};
}

Json mismatch_json(const Mismatch& mismatch) {
  return {{"recording", mismatch.recording},
          {"interval_s", Json::array({number(mismatch.from_s), number(mismatch.to_s)})},
          {"coordinate", mismatch.coordinate},
          {"equation", mismatch.equation},
          {"share_of_excess", number(mismatch.share_of_excess)},
          {"says", mismatch.says}};
}

// Causes are written for angles and torques; on a specimen that moves along a line the same
// numbers are metres and newtons.
std::pair<double, std::string> shown_unit(const Diagnosis& diagnosis, std::string unit) {
  if (!is_linear(diagnosis)) return in_degrees(unit);
  for (const auto& [angular, linear] :
       {std::pair{"Nm", "N"}, std::pair{"rad", "m"}, std::pair{"kg m2", "kg"}}) {
    const auto at = unit.find(angular);
    if (at != std::string::npos) unit.replace(at, std::string_view(angular).size(), linear);
  }
  return {1.0, unit};
}

/// [lower, upper], or null where there is none.
Json interval_json(double lower, double upper) {
  return std::isfinite(lower) && std::isfinite(upper) ? Json::array({lower, upper}) : Json(nullptr);
}

Json parameter_json(const Diagnosis& diagnosis, const CauseParameter& parameter) {
  const auto [factor, unit] = shown_unit(diagnosis, parameter.unit);
  const Json interval = interval_json(factor * parameter.ci95_lower, factor * parameter.ci95_upper);
  Json json = {{"name", parameter.name},
               {"value", number(factor * parameter.value)},
               {"std", number(factor * parameter.std)},
               {"ci95", interval},
               {"unit", unit},
               {"meaning", parameter.meaning}};
  if (interval.is_null()) json["no_interval"] = parameter.no_interval;
  return json;
}

Json evidence_json(const CauseEvidence& evidence) {
  return {{"score_p_value", number(evidence.score_p_value)},
          {"holdout_rmse_ratio", number(evidence.holdout_rmse_ratio)},
          {"delta_bic", number(evidence.delta_bic)},
          {"ablation_ratio", number(evidence.ablation_ratio)},
          {"placebo_ratio", number(evidence.placebo_ratio)},
          {"over_noise", number(evidence.over_noise)},
          {"before_over_noise", number(evidence.before_over_noise)},
          {"left_over", number(evidence.left_over)}};
}

Json cause_json(const Diagnosis& diagnosis, const Cause& cause) {
  Json parameters = Json::array();
  for (const CauseParameter& one : cause.parameters) {
    parameters.push_back(parameter_json(diagnosis, one));
  }
  return {{"effect", cause.effect},
          {"probability", number(cause.probability)},
          {"size_fraction", number(cause.size_fraction)},
          {"size", number(cause.size)},
          {"size_ci95", interval_json(cause.size_ci95_lower, cause.size_ci95_upper)},
          {"unit", cause.unit},
          {"size_of", cause.size_of},
          {"equation", cause.equation},
          {"parameters", std::move(parameters)},
          {"alternatives", cause.alternatives},
          {"stability", number(cause.stability)},
          {"evidence", evidence_json(cause.evidence)}};
}

Json confusable_json(const Confusable& one) {
  return {{"effect", one.effect},
          {"with", one.with},
          {"similarity", number(one.similarity)},
          {"why", one.why}};
}

Json tried_json(const TriedCandidate& tried) {
  return {{"effect", tried.effect},
          {"round", tried.round},
          {"misfit_removed", number(tried.misfit_removed)},
          {"delta_bic", number(tried.delta_bic)},
          {"holdout_rmse_ratio", number(tried.holdout_rmse_ratio)},
          {"outcome", tried.outcome}};
}

Json moved_json(const Diagnosis& diagnosis, const ParameterMove& move) {
  const auto [factor, unit] = shown_unit(diagnosis, move.unit);
  return {{"name", move.name},
          {"before", number(factor * move.before)},
          {"after", number(factor * move.after)},
          {"std", number(factor * move.std)},
          {"unit", unit}};
}

Json holdout_json(const HoldoutProof& proof) {
  return {{"rmse_before_nm", number(proof.rmse_before)},
          {"rmse_after_nm", number(proof.rmse_after)},
          {"ratio", number(proof.ratio)},
          {"ci95", Json::array({number(proof.ci95_lower), number(proof.ci95_upper)})},
          {"noise_floor_nm", number(proof.noise_floor)},
          {"over_noise", number(proof.over_noise())},
          {"nested", proof.nested},
          {"recordings", proof.recordings},
          {"folds", proof.folds}};
}

Json note_json(const std::string& code, const std::string& says) {
  return {{"code", code}, {"says", says}};
}

Json notes_json(const Diagnosis& diagnosis) {
  Json list = findings_json(diagnosis.mistaken);
  for (const std::string& note : diagnosis.notes) list.push_back(note_json("remark", note));
  return list;
}

Json axis_json(const Diagnosis& diagnosis, const TableAxis& axis) {
  const auto [factor, unit] = shown_unit(diagnosis, axis.unit);
  Json values = Json::array();
  for (const double value : axis.values) values.push_back(number(factor * value));
  return {{"coordinate", axis.coordinate}, {"unit", unit}, {"values", std::move(values)}};
}

Json unnamed_json(const Diagnosis& diagnosis, const UnnamedPart& part) {
  Json coordinates = Json::array(), axes = Json::array();
  for (const TableAxis& axis : part.axes) {
    coordinates.push_back(axis.coordinate);
    axes.push_back(axis_json(diagnosis, axis));
  }
  const auto [factor, unit] = shown_unit(diagnosis, "Nm");
  Json torque = Json::array();
  for (const double value : part.torque) torque.push_back(number(factor * value));
  return {{"coordinates", std::move(coordinates)},
          {"equation", part.equation},
          {"evidence", number(part.evidence)},
          {"size_fraction", number(part.size_fraction)},
          {"share", number(part.share)},
          {"holdout_ratio", number(part.holdout_ratio)},
          {"ci95", Json::array({number(part.ci95_lower), number(part.ci95_upper)})},
          {"table", {{"axes", std::move(axes)}, {"torque", std::move(torque)}, {"unit", unit}}},
          {"proposed_equation",
           part.proposed_equation.empty() ? Json(nullptr) : Json(part.proposed_equation)},
          {"says", part.says}};
}

/// An amplitude of a linear specimen is no angle: amplitude_deg is null there.
Json experiment_json(const NextExperiment& next, const Diagnosis& diagnosis) {
  const bool linear = is_linear(diagnosis);
  return {
      {"separates", next.separates},
      {"excitation", next.excitation},
      {"amplitude_deg", linear ? Json(nullptr) : number(in_degrees("rad").first * next.amplitude)},
      {"frequency_hz", number(next.frequency_hz)},
      {"amplitude", number(next.amplitude / unit_of(diagnosis.display.motion).factor)},
      {"separation_sigma", number(next.separation_sigma)},
      {"says", next.says}};
}

Json series_json(const DiagnosedSeries& series, const Diagnosis& diagnosis) {
  const std::string& motion = diagnosis.display.motion;
  const std::string& effort = diagnosis.display.effort;
  Json json = {{"recording", series.recording},
               {"role", series.split == Split::holdout ? "holdout" : "train"},
               {"equation", series.equation},
               {"time", shown(series.time, "s")},
               {"motion", shown(series.motion, motion)},
               {"rate", shown(series.rate, motion)},
               {"measured", shown(series.measured, effort)},
               {"before", shown(series.before, effort)},
               {"after", shown(series.after, effort)}};
  if (!series.motor_angle.empty()) json["motor_angle"] = shown(series.motor_angle, "deg");
  return json;
}

template <class Row, class Write>
Json list_of(const std::vector<Row>& rows, Write write) {
  Json list = Json::array();
  for (const Row& row : rows) list.push_back(write(row));
  return list;
}

}  // namespace

Json to_json(const Diagnosis& diagnosis) {
  Json json = {
      {"schema", kDiagnosisSchema},
      {"dataset", {{"name", diagnosis.dataset}, {"sha256", diagnosis.sha256}}},
      {"baseline",
       {{"model", diagnosis.baseline_model},
        {"rmse_nm",
         {{"train", number(diagnosis.baseline_rmse_train)},
          {"holdout", number(diagnosis.baseline_rmse_holdout)}}},
        {"noise_std_nm", number(diagnosis.noise_std)}}},
      {"verdict", name_of(diagnosis.verdict)},
      {"says", diagnosis.says},
      {"mismatch", list_of(diagnosis.mismatch, mismatch_json)},
      {"causes",
       list_of(diagnosis.causes, [&](const Cause& c) { return cause_json(diagnosis, c); })},
      {"confusable", list_of(diagnosis.confusable, confusable_json)},
      {"holdout", holdout_json(diagnosis.holdout)},
      {"cross_validated",
       diagnosis.cross_validated ? holdout_json(*diagnosis.cross_validated) : Json(nullptr)},
      {"next_experiment", nullptr}};
  if (diagnosis.next_experiment) {
    json["next_experiment"] = experiment_json(*diagnosis.next_experiment, diagnosis);
  }
  if (diagnosis.unnamed) json["unnamed"] = unnamed_json(diagnosis, *diagnosis.unnamed);
  json["quick"] = diagnosis.quick;
  json["interest"] = number(diagnosis.interest);
  json["units"] = units_json(diagnosis);
  json["tried"] = list_of(diagnosis.tried, tried_json);
  json["moved"] =
      list_of(diagnosis.moved, [&](const ParameterMove& m) { return moved_json(diagnosis, m); });
  json["series"] = list_of(diagnosis.series,
                           [&](const DiagnosedSeries& one) { return series_json(one, diagnosis); });
  json["model"] = diagnosis.model ? data::to_json(*diagnosis.model) : Json(nullptr);
  json["notes"] = notes_json(diagnosis);
  return json;
}

}  // namespace flexspline::studies
