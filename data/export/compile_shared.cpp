#include "export/compile_shared.hpp"

#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>

#include "flexspline/core/write_file.hpp"

namespace flexspline::data {
namespace {

/// A folder of its own, gone at the end.
class Scratch {
 public:
  Scratch() {
    std::string pattern = (std::filesystem::temp_directory_path() / "flexspline-XXXXXX").string();
    const char* made = mkdtemp(pattern.data());
    if (made != nullptr) path_ = made;
  }
  ~Scratch() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace

std::optional<std::string> compile_shared(const std::vector<ExportedFile>& sources) {
  const Scratch folder;
  if (folder.path().empty()) return std::nullopt;
  std::string names;
  for (const ExportedFile& file : sources) {
    if (!write_file(folder.path() / file.path, file.content)) return std::nullopt;
    if (file.path.ends_with(".c")) names += " " + file.path;
  }
  const std::string command = fmt::format(
      "cd '{}' && cc -std=c99 -O2 -fPIC -shared -fvisibility=hidden{} -lm -o model.so "
      ">/dev/null 2>&1",
      folder.path().string(), names);
  if (std::system(command.c_str()) != 0) return std::nullopt;
  auto bytes = read_file(folder.path() / "model.so");
  if (!bytes) return std::nullopt;
  return std::move(*bytes);
}

}  // namespace flexspline::data
