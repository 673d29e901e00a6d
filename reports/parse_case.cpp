#include <cmath>

#include <nlohmann/json.hpp>

#include "json_fields.hpp"
#include "parse_artefacts.hpp"

namespace flexspline::reports {
namespace {

using nlohmann::json;

CaseRecording parse_recording(const json& from) {
  CaseRecording recording;
  recording.id = text_in(from, "id");
  recording.trained = text_in(from, "role") == "train";
  recording.amplitude = number_in(from, "amplitude");
  recording.frequency_hz = number_in(from, "frequency_hz");
  recording.rmse = number_in(from, "rmse");
  recording.rmse_percent = number_in(from, "rmse_percent_of_peak");
  recording.rmse_true_percent = number_in(from, "rmse_true_percent_of_peak");
  recording.area_error_percent = number_in(from, "area_error_percent");
  recording.outside_domain = flag_in(from, "outside_domain");
  recording.motion = numbers_in(from, "motion");
  recording.measured = numbers_in(from, "effort_measured");
  recording.simulated = numbers_in(from, "effort_simulated");
  return recording;
}

Parameter parse_parameter(const json& from) {
  Parameter parameter{text_in(from, "name"), text_in(from, "unit")};
  parameter.value = number_in(from, "value");
  parameter.std = number_in(from, "std");
  parameter.bound_active = flag_in(from, "bound_active");
  if (const auto interval = numbers_in(from, "ci95"); interval.size() == 2) {
    parameter.lower = interval[0];
    parameter.upper = interval[1];
  }
  return parameter;
}

Band parse_band(const json& from) {
  Band band;
  band.function = text_in(from, "function");
  band.unit_argument = text_in(from, "unit_argument");
  band.unit_value = text_in(from, "unit_value");
  band.argument = numbers_in(from, "argument");
  band.value = numbers_in(from, "value");
  band.lower = numbers_in(from, "lower");
  band.upper = numbers_in(from, "upper");
  band.valid_from = number_in(from, "valid_from");
  band.valid_to = number_in(from, "valid_to");
  return band;
}

void parse_estimate(const json& from, Case& into) {
  into.termination = text_in(from, "termination");
  into.cost = number_in(from, "cost");
  into.evaluations = number_in(from, "evaluations");
  into.seconds = number_in(from, "seconds");
  into.notes = texts_in(from, "notes");
  for (const json& parameter : member(from, "parameters")) {
    into.parameters.push_back(parse_parameter(parameter));
  }
  for (const json& band : member(from, "bands")) into.bands.push_back(parse_band(band));
  const json& identifiability = member(from, "identifiability");
  into.condition = number_in(identifiability, "condition");
  into.verdict = text_in(identifiability, "verdict");
  into.says = text_in(identifiability, "says");
  for (const json& share : member(identifiability, "absorbed")) {
    into.absorbed.push_back(
        {text_in(share, "parameter"), text_in(share, "by"), number_in(share, "cosine")});
  }
}

}  // namespace

Case parse_case(const json& artefact) {
  Case parsed;
  parsed.key = text_in(artefact, "key");
  parsed.input = text_in(artefact, "input");
  parsed.estimator = text_in(artefact, "estimator");
  parsed.title = text_in(artefact, "title");
  parsed.method = text_in(artefact, "method");
  parsed.train = texts_in(artefact, "train");
  const double replicate = number_in(artefact, "replicate");
  parsed.replicate = std::isfinite(replicate) ? std::lround(replicate) : 0;
  parsed.failed = text_in(artefact, "status") != "done";
  const json& failure = member(artefact, "failure");
  parsed.failure = text_in(failure, "problem");
  if (parsed.failed && parsed.failure.empty()) parsed.failure = "no reason was recorded";
  parsed.remedy = text_in(failure, "remedy");
  parse_estimate(member(artefact, "estimate"), parsed);
  for (const json& recording : member(artefact, "recordings")) {
    parsed.recordings.push_back(parse_recording(recording));
  }
  const json& errors = member(artefact, "function_errors_percent");
  for (const auto& item : errors.items()) {
    parsed.function_errors_percent[item.key()] = number_in(errors, item.key().c_str());
  }
  return parsed;
}

}  // namespace flexspline::reports
