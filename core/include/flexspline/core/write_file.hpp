#pragma once

#include <chrono>
#include <filesystem>
#include <shared_mutex>
#include <string_view>

#include "flexspline/core/error.hpp"

namespace flexspline {

/// Writes the whole file under a temporary name beside it and renames it, so that a reader sees the
/// old file or the new one and never half of it. Creates missing folders.
/// Errors: cannot_write, with the path and the system's reason.
Result<void> write_file(const std::filesystem::path& path, std::string_view content);

/// Held by who writes a file under a temporary name, until it is renamed.
std::shared_lock<std::shared_timed_mutex> writing();

/// Before the program is ended from aside: waits for the writes under way, but no longer than that,
/// and lets no other begin. There is no way back.
void let_no_write_begin(std::chrono::milliseconds patience);

/// Errors: input_missing with the path and the system's reason.
Result<std::string> read_file(const std::filesystem::path& path);

}  // namespace flexspline
