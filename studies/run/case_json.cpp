#include <algorithm>

#include <nlohmann/json.hpp>

#include "comparison/function_errors.hpp"
#include "flexspline/data/estimate_json.hpp"
#include "flexspline/studies/metric.hpp"
#include "plan/motion_range.hpp"
#include "run/artefact_json.hpp"

namespace flexspline::studies {
namespace {

using nlohmann::ordered_json;

ordered_json error_json(const Error& error) {
  constexpr std::pair<ErrorCode, const char*> names[] = {
      {ErrorCode::usage, "usage"},
      {ErrorCode::bad_data, "bad_data"},
      {ErrorCode::input_missing, "input_missing"},
      {ErrorCode::defect, "defect"},
      {ErrorCode::cannot_write, "cannot_write"},
      {ErrorCode::interrupted, "interrupted"},
      {ErrorCode::numerics, "numerics"}};
  const auto name = std::ranges::find(names, error.code, &std::pair<ErrorCode, const char*>::first);
  return {{"code", name == std::end(names) ? "defect" : name->second},
          {"problem", error.problem},
          {"remedy", error.remedy},
          {"context", error.context}};
}

ordered_json recording_json(const RecordingComparison& comparison, const PreparedInput& input) {
  ordered_json object = {{"id", comparison.id}, {"role", comparison.trained ? "train" : "holdout"}};
  const StudyRecording* recording = input.find(comparison.id);
  object["amplitude"] = shown(amplitude_of(*recording), input.units.motion);
  object["frequency_hz"] = recording->record.frequency_hz.value_or(kNotComputed);
  for (const MetricRow& row : metrics()) {
    const double value = comparison.metrics.at(std::string(row.id));
    object[std::string(row.id)] =
        row.unit == MetricUnit::effort ? shown(value, input.units.effort) : value;
  }
  object["outside_domain"] = comparison.outside_domain;
  object["motion"] = shown(comparison.motion, input.units.motion);
  object["effort_measured"] = shown(comparison.measured, input.units.effort);
  object["effort_simulated"] = shown(comparison.simulated, input.units.effort);
  return object;
}

}  // namespace

double shown(double si, const std::string& unit) {
  const std::optional<Unit> found = find_unit(unit);
  return found ? si / found->factor : si;
}

std::vector<double> shown(const std::vector<double>& si, const std::string& unit) {
  std::vector<double> values;
  values.reserve(si.size());
  for (const double value : si) values.push_back(shown(value, unit));
  return values;
}

double amplitude_of(const StudyRecording& recording) {
  if (recording.truth && recording.record.amplitude) return *recording.record.amplitude;
  return 0.5 * motion_range(recording.record);
}

ordered_json case_json(const CasePlan& plan, const PreparedInput* input,
                       const CaseOutcome& outcome) {
  const bool done = outcome.estimate.has_value() && input != nullptr;
  ordered_json object = {
      {"schema", kCaseSchema},
      {"key", plan.key},
      {"input", plan.input->id},
      {"estimator", plan.estimator->id},
      {"title", plan.estimator->title},
      {"method", plan.estimator->method},
      {"train", plan.train},
      {"replicate", plan.replicate},
      {"seed", plan.seed},
      {"depends_on", plan.depends_on},
      {"units", nullptr},
      {"status", done ? "done" : "failed"},
      {"failure", nullptr},
      {"estimate", nullptr},
      {"recordings", ordered_json::array()},
      {"function_errors_percent", {{"f", nullptr}, {"g_inverse", nullptr}, {"h", nullptr}}}};
  if (!done) {
    object["failure"] = error_json(outcome.estimate.error());
    return object;
  }
  object["units"] = {{"motion", input->units.motion}, {"effort", input->units.effort}};
  object["estimate"] = data::to_json(*outcome.estimate, input->units);
  object["estimate"].erase("seconds");  // wall_times: the same run gives the same bytes
  for (const RecordingComparison& comparison : outcome.recordings) {
    object["recordings"].push_back(recording_json(comparison, *input));
  }
  for (const auto& [name, value] : function_errors(*outcome.estimate, *input, plan.train)) {
    object["function_errors_percent"][name] = value;
  }
  return object;
}

}  // namespace flexspline::studies
