#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace flexspline::app {

/// The rows of a catalogue, as `list --json` gives them, for a person.
std::string catalogue_text(const nlohmann::ordered_json& rows);
/// One value of a row: text as it is, yes or no, a list by commas.
std::string words(const nlohmann::ordered_json& value);

}  // namespace flexspline::app
