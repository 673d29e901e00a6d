#pragma once

#include <nlohmann/json_fwd.hpp>

#include "flexspline/reports/artefacts.hpp"

namespace flexspline::reports {

/// The artefacts of docs/artefacts.md out of their JSON.
Input parse_input(const nlohmann::json& artefact);
Case parse_case(const nlohmann::json& artefact);
Paper parse_paper(const nlohmann::json& artefact);

}  // namespace flexspline::reports
