#pragma once

#include <nlohmann/json_fwd.hpp>

#include "paper/virtual_recording.hpp"

namespace flexspline::studies {

/// Figures 4 to 12 as series, docs/artefacts.md.
nlohmann::ordered_json paper_figures(const PaperExperiment& experiment);

}  // namespace flexspline::studies
