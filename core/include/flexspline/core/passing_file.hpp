#pragma once

#include <filesystem>

namespace flexspline {

/// Name of a file that is removed when this goes out of scope, or when the program is ended by a
/// signal it knows of. Who writes the file is not said here.
class PassingFile {
 public:
  explicit PassingFile(std::filesystem::path path);
  PassingFile(const PassingFile&) = delete;
  PassingFile& operator=(const PassingFile&) = delete;
  ~PassingFile();

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int slot_;
};

}  // namespace flexspline
