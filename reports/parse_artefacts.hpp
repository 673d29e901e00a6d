#pragma once

#include <nlohmann/json_fwd.hpp>

#include "flexspline/reports/artefacts.hpp"
#include "flexspline/reports/diagnosis_view.hpp"
#include "flexspline/reports/trial_view.hpp"
#include "flexspline/reports/verification_view.hpp"

namespace flexspline::reports {

/// The artefacts of docs/artefacts.md out of their JSON.
Input parse_input(const nlohmann::json& artefact);
Case parse_case(const nlohmann::json& artefact);
Paper parse_paper(const nlohmann::json& artefact);
Kind parse_kind(const nlohmann::json& artefact);
DiagnosisView parse_diagnosis(const nlohmann::json& artefact);
TrialView parse_trial(const nlohmann::json& artefact);
VerificationView parse_verification(const nlohmann::json& artefact);

}  // namespace flexspline::reports
