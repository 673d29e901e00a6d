#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "flexspline/core/error.hpp"

namespace flexspline::data {

/// The lines of a file one after the other, in memory that does not grow with the file.
class LineSource {
 public:
  static constexpr std::size_t kLongestLine = std::size_t{1} << 20U;  ///< bytes

  /// Errors: input_missing for what cannot be opened or is no regular file (a pipe would block).
  static Result<LineSource> open(const std::filesystem::path& path);

  LineSource(LineSource&& other) noexcept;
  LineSource& operator=(LineSource&&) = delete;
  ~LineSource();

  /// The next line without its end, until the next call; nothing at the end of the file or where
  /// reading failed. A line beyond the longest comes back cut there, with is_cut().
  std::optional<std::string_view> next();

  bool is_cut() const { return cut_; }
  /// What the system said when reading failed, or that the file has changed; empty where neither.
  const std::string& problem() const { return problem_; }
  std::size_t file_bytes() const { return file_bytes_; }

 private:
  LineSource(int file, std::size_t file_bytes, std::int64_t changed_ns)
      : file_(file), file_bytes_(file_bytes), changed_ns_(changed_ns) {}
  bool has_changed() const;
  /// False at the end of the file.
  bool read_more();

  int file_;
  std::size_t file_bytes_;
  std::int64_t changed_ns_;  ///< since 1970
  std::string buffer_;
  std::size_t begin_ = 0;  ///< of what was not given yet
  std::size_t end_ = 0;    ///< of what was read
  bool cut_ = false;
  std::string problem_;
};

}  // namespace flexspline::data
