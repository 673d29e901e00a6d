#include "run/study_folder.hpp"

#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "config/json_to_toml.hpp"
#include "config/study_json.hpp"
#include "config/study_source.hpp"
#include "flexspline/core/write_file.hpp"
#include "flexspline/data/artefact.hpp"
#include "flexspline/data/checksum.hpp"
#include "run/artefact_json.hpp"

namespace flexspline::studies {

using nlohmann::ordered_json;

namespace {

constexpr std::size_t kMostListed = 10'000;  // cases by name

/// What a study that is more than its grid is read back from.
void add_source(const StudyConfig& study, ordered_json& lock) {
  if (study.source == nullptr || (study.kind == "grid" && study.sweeps.empty())) return;
  std::error_code ignored;
  const auto place = [&](const std::filesystem::path& path) {
    return std::filesystem::absolute(path, ignored).lexically_normal().generic_string();
  };
  lock["source"] = {{"file", place(study.source->file)},
                    {"data_root", place(study.source->data_root)},
                    {"model_root", place(study.source->model_root)},
                    {"text", study.source->text}};
}

}  // namespace

bool is_valid(const std::filesystem::path& file, std::string_view schema,
              const std::string& depends_on) {
  const auto artefact = data::read_artefact(file, schema);
  return artefact && artefact->value("depends_on", "") == depends_on;
}

Result<void> write_lock(const StudyPlan& plan, const RunSettings& settings) {
  ordered_json lock = {{"schema", "flexspline-study-lock/1"},
                       {"build_id", settings.build_id},
                       {"versions", settings.versions},
                       {"study", to_json(*plan.study)}};
  if (const auto text = read_file(plan.study->file)) lock["study_sha256"] = data::sha256_hex(*text);
  for (const auto& [id, set] : plan.datasets) {
    lock["datasets"][id] = {{"sha256", set.sha256}, {"split", plan.notes.at(id)}};
  }
  for (int replicate = 0; replicate < plan.study->replicates; ++replicate) {
    lock["seeds"].push_back(seed_of(*plan.study, replicate));
  }
  lock["count"] = plan.size();
  if (plan.size() <= kMostListed) {
    for (std::size_t i = 0; i < plan.size(); ++i) {
      const CasePlan one = plan.at(i);
      lock["cases"][one.key] = one.depends_on;
    }
  }
  add_source(*plan.study, lock);
  return write_file(
      settings.folder / "study.lock.toml",
      "# What this folder was computed from. Written by flexspline.\n" + toml_text(lock));
}

void set_aside(const std::filesystem::path& folder, const std::set<std::string>& kept,
               const RunSettings& settings) {
  std::error_code ignored;
  std::vector<std::filesystem::path> stale;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const std::filesystem::path& path = entry.path();
    if (path.extension() == ".json" && !kept.contains(path.filename().string()))
      stale.push_back(path);
  }
  for (const std::filesystem::path& path : stale) {
    std::filesystem::rename(path, path.string() + ".stale", ignored);
    if (settings.log)
      settings.log(fmt::format("{} is not part of the study any more: set aside", path.string()));
  }
}

}  // namespace flexspline::studies
