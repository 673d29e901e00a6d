#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <shared_mutex>
#include <string>
#include <vector>

#include "flexspline/core/error.hpp"

namespace flexspline::data {

/// A CSV table that is written row by row under a temporary name, and renamed when it is whole.
/// Holds plain names and numbers alone, so that no spreadsheet finds a formula in it.
class RowWriter {
 public:
  /// Errors: cannot_write, with the system's reason.
  static Result<RowWriter> open(const std::filesystem::path& path,
                                const std::vector<std::string>& names);
  RowWriter(RowWriter&&) noexcept = default;
  RowWriter& operator=(RowWriter&&) noexcept;
  ~RowWriter();

  void add(const std::vector<double>& row);
  std::size_t rows() const { return rows_; }

  /// Errors: cannot_write, where a row could not be written.
  Result<void> finish();

 private:
  RowWriter() = default;
  void flush();
  void drop();

  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> file_;
  std::filesystem::path path_;
  std::string text_;
  std::size_t rows_ = 0;
  bool failed_ = false;
};

}  // namespace flexspline::data
