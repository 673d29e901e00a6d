#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace flexspline::app {

/// An rms error for a person: "0.412 Nm, 1.3 % of the recording's peak". Larger than the signal
/// itself it is called diverged; absent (null), not computed; of a recording outside the domain of
/// the fit, extrapolated.
std::string error_text(const nlohmann::ordered_json& rmse, const std::string& unit,
                       const nlohmann::ordered_json& percent_of_peak, bool outside_domain);

/// "\n  note: ..." for each of them.
std::string notes_text(const nlohmann::ordered_json& notes);

}  // namespace flexspline::app
