#pragma once

#include <filesystem>

#include "flexspline/core/error.hpp"

namespace flexspline::data {

/// The path of a table that a description names, made sure to be inside its folder.
/// Errors: bad_data for a path that is absolute, climbs out of the folder (by .. or by a link), or
/// is no CSV file that is there.
Result<std::filesystem::path> table_path(const std::filesystem::path& folder,
                                         const std::filesystem::path& file);

}  // namespace flexspline::data
