#pragma once

#include <vector>

#include <nlohmann/json.hpp>

#include "flexspline/data/sanity.hpp"

namespace flexspline::studies {

/// What looks mistaken in recordings, as artefacts hold it: code, says, check, severity, recording.
nlohmann::ordered_json findings_json(const std::vector<data::SanityFinding>& findings);

}  // namespace flexspline::studies
