#include "source_tree.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>

#include "source_dir.hpp"

namespace flexspline::house {

namespace fs = std::filesystem;

namespace {

const std::set<std::string> kCode = {".cpp", ".hpp"};
const std::set<std::string> kCMake = {".cmake", "CMakeLists.txt"};
const std::set<std::string> kText = {".cpp",    ".hpp",        ".cmake",       "CMakeLists.txt",
                                     ".md",     ".toml",       ".json",        ".js",
                                     ".css",    ".html",       ".mjs",         ".sh",
                                     ".cff",    ".yml",        ".txt",         ".py",
                                     ".ts",     ".m",          ".lua",         ".in",
                                     ".sbatch", "run",         "bootstrap",    "Snakefile",
                                     ".pyi",    ".clang-tidy", ".clang-format"};
const std::set<std::string> kNotOurs = {".git", "build", "out", "node_modules", ".cache"};

bool starts_with_any(const std::string& text, const std::vector<std::string>& beginnings) {
  for (const auto& beginning : beginnings) {
    if (text.starts_with(beginning)) return true;
  }
  return false;
}

void append_lines(const fs::path& root, const fs::path& file, std::vector<SourceLine>& lines) {
  std::ifstream stream(file);
  std::string text;
  for (int number = 1; std::getline(stream, text); ++number) {
    lines.push_back({fs::relative(file, root).generic_string(), number, text});
  }
}

std::vector<SourceLine> lines_of(const std::set<std::string>& kinds) {
  const fs::path root = FLEXSPLINE_SOURCE_DIR;
  std::vector<SourceLine> lines;
  for (auto entry = fs::recursive_directory_iterator(root); entry != fs::end(entry); ++entry) {
    const fs::path& path = entry->path();
    if (entry->is_directory() && kNotOurs.contains(path.filename().string())) {
      entry.disable_recursion_pending();
    } else if (entry->is_regular_file() && (kinds.contains(path.filename().string()) ||
                                            kinds.contains(path.extension().string()))) {
      append_lines(root, path, lines);
    }
  }
  return lines;
}

/// The layer that a file lies in; the application and the tests count as layers of their own.
std::string layer_of(const std::string& file) {
  if (file.starts_with("studies/app/")) return "app";
  return file.substr(0, file.find('/'));
}

bool layer_may_include(const std::string& layer, const std::string& header) {
  static const std::map<std::string, std::set<std::string>> kMayInclude = {
      {"core", {"core"}},
      {"data", {"data", "core"}},
      {"estimators", {"estimators", "core"}},
      {"reports", {"reports", "core"}},
      {"studies", {"studies", "core", "data", "estimators"}},
  };
  static const std::string kPrefix = "flexspline/";
  if (!header.starts_with(kPrefix) || !kMayInclude.contains(layer)) return true;
  const std::string other =
      header.substr(kPrefix.size(), header.find('/', kPrefix.size()) - kPrefix.size());
  return kMayInclude.at(layer).contains(other);
}

// The rooms of the diagnosis, each of which knows those before it.
bool room_may_include(const std::string& file, const std::string& header) {
  static const std::vector<std::string> kRooms = {"frame", "model",   "causes", "parts", "search",
                                                  "proof", "unnamed", "next",   "names", "words"};
  static const std::string kPrefix = "diagnosis/";
  const auto room_of = [](const std::string& path) {
    const std::string name = path.substr(0, path.find('/'));
    return std::ranges::find(kRooms, name) - kRooms.begin();
  };
  static const std::string kFolder = "studies/" + kPrefix;
  if (!file.starts_with(kFolder) || !header.starts_with(kPrefix)) return true;
  return room_of(header.substr(kPrefix.size())) <= room_of(file.substr(kFolder.size()));
}

bool library_may_be_named(const std::string& file, const std::string& header) {
  static const std::regex kSundials(
      "(sundials|cvodes?|idas?|arkode|kinsol|nvector|sunmatrix|sunlinsol|sunnonlinsol)/.*");
  static const std::regex kSolvers("(ceres|coin|coin-or)/.*|Ip[A-Z].*\\.hpp");
  if (std::regex_match(header, kSundials)) return file.starts_with("core/integrators/");
  if (std::regex_match(header, kSolvers)) return file.starts_with("estimators/solvers/");
  return true;
}

}  // namespace

std::vector<SourceLine> lines_of_code() { return lines_of(kCode); }
std::vector<SourceLine> lines_of_cmake() { return lines_of(kCMake); }
std::vector<SourceLine> lines_of_text() { return lines_of(kText); }

std::string included(const std::string& text) {
  static const std::regex kInclude("^\\s*#\\s*include\\s*[<\"]([^>\"]+)[>\"].*");
  std::smatch match;
  return std::regex_match(text, match, kInclude) ? match[1].str() : std::string();
}

bool may_include(const std::string& file, const std::string& header) {
  const std::string layer = layer_of(file);
  if (header.find("../") != std::string::npos) return false;
  if (layer != "tests" && header.starts_with("tests/")) return false;
  if (layer != "app" && starts_with_any(header, {"app/", "commands/", "studies/app/"}))
    return false;
  return layer_may_include(layer, header) && room_may_include(file, header) &&
         library_may_be_named(file, header);
}

bool names_a_private_path(const std::string& text) {
  static const std::regex kPrivate("(^|[^\\w./}>-])/(home|root|work|Users|mnt)/\\w");
  return std::regex_search(text, kPrivate);
}

}  // namespace flexspline::house
