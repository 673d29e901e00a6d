#include "verify/circumstances.hpp"

#include <map>
#include <set>

#include <nlohmann/json.hpp>

#include "config/locked_json.hpp"
#include "flexspline/core/nesting.hpp"
#include "flexspline/core/write_file.hpp"

namespace flexspline::studies {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// What a folder says it was computed from: a lock file, or a diagnosis or trial that says it
/// itself.
json origin_of(const fs::path& folder) {
  if (auto lock = read_lock_json(folder / "study.lock.toml")) return *std::move(lock);
  for (const char* name : {"diagnosis.json", "trial.json"}) {
    const auto text = read_file(folder / name);
    if (!text || !check_nesting(*text)) continue;
    const json artefact = json::parse(*text, nullptr, false);
    if (!artefact.is_object()) continue;
    json origin = json::object();
    for (const char* key : {"versions", "build_id", "design"}) {
      if (artefact.contains(key)) origin[key] = artefact[key];
    }
    if (artefact.contains("dataset")) {
      origin["datasets"]["recordings"] = artefact["dataset"];
    }
    return origin;
  }
  return json::object();
}

std::string kind_of(const std::string& path) {
  const auto starts = [&](std::string_view with) { return path.starts_with(with); };
  if (starts("datasets/")) return "data";
  if (starts("seeds") || path == "study/seed" || path == "design/seed") return "seed";
  for (const char* code :
       {"versions/flexspline", "versions/commit", "versions/build", "build_id"}) {
    if (path == code) return "code";
  }
  return starts("versions/") ? "library" : "configuration";
}

constexpr std::size_t kToldOfHash = 16;

bool is_hash(const std::string& text) {
  return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

void flatten(const json& from, const std::string& path, std::map<std::string, std::string>& into) {
  if (from.is_object()) {
    for (const auto& [key, value] : from.items()) {
      flatten(value, path.empty() ? key : path + "/" + key, into);
    }
  } else {
    const std::string text = from.is_string() ? from.get<std::string>() : from.dump();
    into[path] = is_hash(text) ? text.substr(0, kToldOfHash) : text;
  }
}

/// Hashes of what is told by its parts, names of data sets, and the build told twice.
bool is_told_elsewhere(const std::string& path) {
  return path.starts_with("cases/") || path.starts_with("source/") || path == "study_sha256" ||
         path == "schema" || path == "versions/build" || path.ends_with("/name");
}

}  // namespace

std::vector<Circumstance> other_data(const fs::path& folder,
                                     const std::map<std::string, std::string>& sha256) {
  std::vector<Circumstance> other;
  const json origin = origin_of(folder);
  for (const auto& [id, now] : sha256) {
    const json::json_pointer place = json::json_pointer("/datasets") / id / "sha256";
    if (!origin.contains(place) || !origin[place].is_string()) continue;
    const auto before = origin[place].get<std::string>();
    if (before == now) continue;
    other.push_back({"data", "datasets/" + id + "/sha256", before.substr(0, kToldOfHash),
                     now.substr(0, kToldOfHash)});
  }
  return other;
}

std::vector<Circumstance> changed_circumstances(const fs::path& folder, const fs::path& against) {
  std::map<std::string, std::string> before, after;
  flatten(origin_of(folder), {}, before);
  flatten(origin_of(against), {}, after);
  std::vector<Circumstance> changed;
  for (const auto& [path, value] : before) {
    const auto other = after.find(path);
    if (is_told_elsewhere(path) || other == after.end() || other->second == value) continue;
    changed.push_back({kind_of(path), path, value, other->second});
  }
  return changed;
}

}  // namespace flexspline::studies
