#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "flexspline/core/recording.hpp"

namespace flexspline::data {

/// Whether a set may accept it: check_units, check_sign, check_ratio, check_channel, or the id of one
/// check.
bool is_sanity_code(std::string_view code);
std::string sanity_code_suggestion(std::string_view code);

/// From now on findings of this code are no mistake in the set: they are warnings. Kept as a note
/// of the set, where every report shows it.
void accept_finding(RecordingSet& set, std::string_view code);
std::vector<std::string_view> accepted_findings(const RecordingSet& set);

}  // namespace flexspline::data
