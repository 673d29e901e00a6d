#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "flexspline/studies/trial.hpp"

namespace flexspline::studies {

/// What a case artefact holds of a diagnosis: verdict, causes, mismatch, hold-out, notes.
nlohmann::ordered_json excerpt_of(const Diagnosis& diagnosis);

nlohmann::ordered_json to_json(const CaseScore& score);
nlohmann::ordered_json to_json(const std::vector<EffectTrace>& traces);

/// A case as its artefact (docs/trials.md) holds it. Errors: bad_data.
Result<ScoredCase> scored_case_from_json(const nlohmann::ordered_json& artefact);

/// What a trial was told to draw.
nlohmann::ordered_json design_json(const TrialConfig& trial);

/// DIR/trial.json.
nlohmann::ordered_json trial_json(const TrialConfig& trial, const TrialSummary& summary,
                                  const std::string& build_id);

/// DIR/tables/*.csv and *.md. Errors: cannot_write.
Result<void> write_trial_tables(const TrialSummary& summary, const std::filesystem::path& folder);

/// Single effects whose size, or trace, lies in [from, to).
struct DetectionBin {
  double from = 0.0;
  double to = 0.0;
  int cases = 0;
  int detected = 0;
  int first_right = 0;
  int exact = 0;
};

std::vector<DetectionBin> detection_by_size(const std::vector<ScoredCase>& cases);
std::vector<DetectionBin> detection_by_trace(const std::vector<ScoredCase>& cases);

/// How often a truth got a first name; pairs are "two effects" and "one of the two".
using Confusion = std::map<std::pair<std::string, std::string>, int>;

Confusion confusion_of(const std::vector<ScoredCase>& cases);

/// The cases by generator, and by what disturbs them ("none": nothing).
std::map<std::string, std::vector<ScoredCase>> by_generator(const std::vector<ScoredCase>& cases);
std::map<std::string, std::vector<ScoredCase>> by_disturbance(const std::vector<ScoredCase>& cases);

/// The cases of one rig, and of one single effect on it.
std::vector<ScoredCase> of_rig(const std::vector<ScoredCase>& cases, data::BenchKind rig);
std::map<std::pair<std::string, std::string>, std::vector<ScoredCase>> by_effect(
    const std::vector<ScoredCase>& cases);

}  // namespace flexspline::studies
