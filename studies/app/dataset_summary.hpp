#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "flexspline/core/recording.hpp"

namespace flexspline::app {

/// What was understood of a data set: of every recording rows, rate, duration, the range of each
/// channel with its unit, the peak of its torques, and the excitation as stated and as measured.
nlohmann::ordered_json dataset_summary(const RecordingSet& set);

/// The same for a person.
std::string summary_text(const nlohmann::ordered_json& summary);

}  // namespace flexspline::app
