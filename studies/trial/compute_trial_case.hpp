#pragma once

#include <nlohmann/json_fwd.hpp>

#include "flexspline/studies/trial.hpp"

namespace flexspline::studies {

/// What the result of a case rests on: build, bench, effects, time limit.
std::string dependencies_of(const TrialConfig& trial, const TrialCase& one,
                            const std::string& build_id);

/// Conceals one case, writes its commitment, has it diagnosed, unseals and scores it. Gives its
/// artefact (docs/trials.md); a bench that cannot conceal and a diagnosis that fails are told
/// there. Errors: cannot_write, defect.
Result<nlohmann::ordered_json> compute_trial_case(const TrialConfig& trial, const TrialCase& one,
                                                  const TrialSettings& settings,
                                                  const Diagnose& diagnose);

}  // namespace flexspline::studies
