#pragma once

#include <filesystem>
#include <string>

#include "flexspline/core/error.hpp"

namespace flexspline::studies {

/// Appends a case's wall time to seconds.csv, in one write, so that workers do not mix their lines.
/// A case that is computed again has its last line count. Errors: cannot_write.
Result<void> add_wall_time(const std::filesystem::path& folder, const std::string& key,
                           double seconds);

}  // namespace flexspline::studies
