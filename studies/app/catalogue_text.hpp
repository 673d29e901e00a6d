#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace flexspline::app {

/// The rows of a catalogue, as `list --json` gives them, for a person.
std::string catalogue_text(const nlohmann::ordered_json& rows);

}  // namespace flexspline::app
