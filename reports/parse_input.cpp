#include <nlohmann/json.hpp>

#include "findings.hpp"
#include "json_fields.hpp"
#include "parse_artefacts.hpp"

namespace flexspline::reports {
namespace {

using nlohmann::json;

InputRecording parse_recording(const json& from) {
  InputRecording recording;
  recording.id = text_in(from, "id");
  recording.role = text_in(from, "role");
  recording.amplitude = number_in(from, "amplitude");
  recording.frequency_hz = number_in(from, "frequency_hz");
  recording.peak_effort = number_in(from, "peak_effort");
  recording.half_height = number_in(from, "half_height");
  recording.loop_area = number_in(from, "loop_area");
  recording.time = numbers_in(from, "time");
  recording.motion = numbers_in(from, "motion");
  recording.effort = numbers_in(from, "effort");
  return recording;
}

ShownUnits parse_units(const json& from) {
  ShownUnits units;
  if (const auto motion = text_in(from, "motion"); !motion.empty()) units.motion = motion;
  if (const auto rate = text_in(from, "rate"); !rate.empty()) units.rate = rate;
  if (const auto effort = text_in(from, "effort"); !effort.empty()) units.effort = effort;
  return units;
}

}  // namespace

Input parse_input(const json& artefact) {
  Input input;
  input.id = text_in(artefact, "id");
  input.title = text_in(artefact, "title");
  if (input.title.empty()) input.title = input.id;
  input.kind = text_in(artefact, "kind");
  input.says = text_in(artefact, "says");
  input.truth_id = text_in(artefact, "truth");
  input.source = text_in(artefact, "source");
  input.license = text_in(artefact, "license");
  input.units = parse_units(member(artefact, "units"));
  for (const json& recording : member(artefact, "recordings")) {
    input.recordings.push_back(parse_recording(recording));
  }
  if (artefact.contains("findings")) {
    auto& findings = input.findings.emplace();
    for (const json& one : member(artefact, "findings")) findings.push_back(parse_finding(one));
  }
  for (const auto& [name, curve] : member(artefact, "truth_functions").items()) {
    input.truth[name] = {numbers_in(curve, "argument"), numbers_in(curve, "value")};
  }
  return input;
}

}  // namespace flexspline::reports
