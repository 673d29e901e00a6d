#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include <sys/stat.h>

#include "flexspline/core/error.hpp"

namespace flexspline::data {

/// A regular file that is read by pieces. It knows whether it has changed since it was opened.
class InputFile {
 public:
  /// Errors: input_missing, with the system's reason; for what is no regular file.
  static Result<InputFile> open(const std::filesystem::path& path);

  InputFile(InputFile&& other) noexcept;
  InputFile& operator=(InputFile&&) = delete;
  ~InputFile();

  std::size_t size() const { return static_cast<std::size_t>(status_.st_size); }
  const std::filesystem::path& path() const { return path_; }

  /// Up to so many bytes from a place; fewer at the end of the file. Errors: bad_data.
  Result<std::size_t> read(std::size_t from, char* to, std::size_t count) const;
  Result<std::string> read(std::size_t from, std::size_t count) const;

  /// Errors: bad_data, where its size or time of change is not what it was.
  Result<void> check_unchanged() const;

 private:
  InputFile(int file, std::filesystem::path path) : file_(file), path_(std::move(path)) {}

  int file_;
  std::filesystem::path path_;
  struct stat status_ {};
};

}  // namespace flexspline::data
