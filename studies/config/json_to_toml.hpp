#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace flexspline::studies {

/// A JSON object as TOML text, keys in alphabetical order. null has no TOML form and is left out.
std::string toml_text(const nlohmann::ordered_json& object);

}  // namespace flexspline::studies
