#pragma once

#include <chrono>
#include <filesystem>
#include <shared_mutex>
#include <string_view>
#include <system_error>

#include "flexspline/core/error.hpp"

namespace flexspline {

/// Writes the whole file under a temporary name beside it and renames it, so that a reader sees the
/// old file or the new one and never half of it. Creates missing folders.
/// Errors: cannot_write, with the path and the system's reason.
Result<void> write_file(const std::filesystem::path& path, std::string_view content);

/// Whether a path names something; false where it cannot be looked at.
bool file_exists(const std::filesystem::path& path);

/// Held by who appends to a file, until what belongs together is written.
std::shared_lock<std::shared_timed_mutex> writing();

/// A file on its way: whoever writes it writes to `path()`, a name beside the final one, and ends
/// with `finish()`. One that is not finished is removed, by the destructor or by who ends the
/// program.
class UnfinishedFile {
 public:
  /// `final_path` as it shall be called; a link of that name is replaced, not written through.
  explicit UnfinishedFile(std::filesystem::path final_path);
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;
  ~UnfinishedFile();

  const std::filesystem::path& path() const { return temporary_; }

  /// Gives the file its final name. The system's error, or none.
  std::error_code finish();

 private:
  std::shared_lock<std::shared_timed_mutex> writing_;
  std::filesystem::path final_path_, temporary_;
  int slot_;
};

/// Before the program is ended from aside: waits for the writes under way, but no longer than that,
/// lets no other begin, and removes what is still unfinished. There is no way back.
void let_no_write_begin(std::chrono::milliseconds patience);

/// Removes every unfinished file of this process at once. Async-signal-safe; for a process that
/// ends.
void remove_unfinished_files();

/// Errors: input_missing with the path and the system's reason.
Result<std::string> read_file(const std::filesystem::path& path);

}  // namespace flexspline
