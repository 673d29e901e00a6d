#pragma once

#include <filesystem>
#include <string_view>

#include "flexspline/core/error.hpp"

namespace flexspline {

/// Writes the whole file under a temporary name beside it and renames it, so that a reader sees the
/// old file or the new one and never half of it. Creates missing folders.
/// Errors: cannot_write, with the path and the system's reason.
Result<void> write_file(const std::filesystem::path& path, std::string_view content);

/// Errors: input_missing with the path and the system's reason.
Result<std::string> read_file(const std::filesystem::path& path);

}  // namespace flexspline
