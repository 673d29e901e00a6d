#pragma once

#include <nlohmann/json.hpp>

#include "flexspline/studies/trial.hpp"

namespace flexspline::studies {

/// What the result of a case rests on: build, diagnosis, bench, effects, time limit.
std::string dependencies_of(const TrialConfig& trial, const TrialCase& one,
                            const TrialSettings& settings);

struct TrialCaseResult {
  nlohmann::ordered_json artefact;  ///< docs/trials.md
  double seconds = 0.0;             ///< of the diagnosis
};

/// Conceals one case, writes its commitment, has it diagnosed, unseals and scores it. A bench that
/// cannot conceal and a diagnosis that fails are told in the artefact. Without a folder to run in
/// nothing is written. Errors: cannot_write, defect.
Result<TrialCaseResult> compute_trial_case(const TrialConfig& trial, const TrialCase& one,
                                           const TrialSettings& settings, const Diagnose& diagnose);

}  // namespace flexspline::studies
