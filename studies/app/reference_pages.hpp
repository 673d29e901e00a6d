#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "flexspline/core/error.hpp"

namespace flexspline::app {

/// A catalogue as a page in Markdown, all of it from its rows (as `list --json` prints them).
std::string catalogue_page(std::string_view name, const nlohmann::ordered_json& rows);

/// The formats of all files: every key with its type, range and meaning, from their JSON schemas.
std::string formats_page();

/// Writes a page for every catalogue, of the formats, and README.md, which lists them.
/// Errors: cannot_write; a file of a page's name that is none, unless force.
Result<void> write_reference(const std::filesystem::path& folder,
                             const std::map<std::string, nlohmann::ordered_json>& catalogues,
                             bool force);

}  // namespace flexspline::app
