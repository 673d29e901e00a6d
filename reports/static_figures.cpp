#include "static_figures.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "flexspline/core/write_file.hpp"
#include "numbers.hpp"
#include "page.hpp"

extern char** environ;

namespace flexspline::reports {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNotDrawn = "not-drawn.txt";

/// A folder of its own under the system's temporary one, gone with this object.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::error_code ignored;
    std::string name = (fs::temp_directory_path(ignored) / "flexspline-figures-XXXXXX").string();
    if (::mkdtemp(name.data()) != nullptr) path_ = name;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// Runs a program of PATH with files as its standard streams; true where it ended well.
bool run_with_files(const char* program, const fs::path& script, const fs::path& input,
                    const fs::path& output) {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, input.c_str(), O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, output.c_str(), O_WRONLY | O_CREAT,
                                   S_IRUSR | S_IWUSR);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  std::string name = program, file = script.string();
  std::array<char*, 3> arguments = {name.data(), file.data(), nullptr};
  pid_t child = 0;
  const int failed = ::posix_spawnp(&child, program, &files, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  int status = 0;
  if (failed != 0 || ::waitpid(child, &status, 0) != child) return false;
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// Pictures by the id of their figure; discarded where node gave none.
nlohmann::json drawn_by_node(std::string_view figures) {
  const auto nothing = nlohmann::json(nlohmann::json::value_t::discarded);
  const TemporaryFolder folder;
  const fs::path script = folder.path() / "draw.cjs", input = folder.path() / "figures.json";
  const fs::path output = folder.path() / "pictures.json";
  if (folder.path().empty() || !write_file(script, page_script()) || !write_file(input, figures)) {
    return nothing;
  }
  if (!run_with_files("node", script, input, output) &&
      !run_with_files("nodejs", script, input, output)) {
    return nothing;
  }
  const auto text = read_file(output);
  return text ? nlohmann::json::parse(*text, nullptr, false) : nothing;
}

/// What an earlier report left there.
void clear(const fs::path& folder) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const fs::path& path = entry.path();
    if (path.extension() == ".svg" || path.filename() == kNotDrawn) fs::remove(path, ignored);
  }
}

}  // namespace

Result<void> write_static_figures(const fs::path& folder, std::string_view figures) {
  clear(folder);
  const nlohmann::json pictures = drawn_by_node(figures);
  if (!pictures.is_object()) {
    return write_file(folder / kNotDrawn,
                      "The figures as SVG files are drawn by node, which is not on PATH or did not "
                      "end well.\nInstall it (Debian: apt-get install nodejs) and draw the report "
                      "again. The page does not need it.\n");
  }
  for (const auto& [id, picture] : pictures.items()) {
    if (!picture.is_string()) continue;
    const auto written = write_file(folder / (slug(id) + ".svg"), picture.get<std::string>());
    if (!written) return written;
  }
  return {};
}

}  // namespace flexspline::reports
