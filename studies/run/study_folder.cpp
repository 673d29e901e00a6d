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

}  // namespace

std::string lasting(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::absolute(path, ignored).lexically_normal().generic_string();
}

namespace {

/// What a study is told apart by, and one that is more than its grid is read back from.
void add_source(const StudyConfig& study, ordered_json& lock) {
  if (study.source == nullptr) return;
  lock["source"] = {{"file", lasting(study.source->file)},
                    {"data_root", lasting(study.source->data_root)},
                    {"model_root", lasting(study.source->model_root)},
                    {"text", study.source->text}};
}

}  // namespace

bool is_valid(const std::filesystem::path& file, std::string_view schema,
              const std::string& depends_on) {
  const auto artefact = data::read_artefact(file, schema);
  return artefact && artefact->value("depends_on", "") == depends_on;
}

ordered_json lock_head(const RunSettings& settings) {
  return {{"schema", "flexspline-study-lock/1"},
          {"build_id", settings.build_id},
          {"versions", settings.versions}};
}

void add_cases(const CaseSource& cases, ordered_json& lock) {
  lock["count"] = cases.size();
  if (cases.size() > kMostListed) return;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const CaseName one = cases.name(i);
    lock["cases"][one.key] = one.depends_on;
  }
}

Result<void> write_lock(const std::filesystem::path& folder, const ordered_json& lock) {
  return write_file(
      folder / "study.lock.toml",
      "# What this folder was computed from. Written by flexspline.\n" + toml_text(lock));
}

Result<void> write_lock(const StudyPlan& plan, const CaseSource& cases,
                        const RunSettings& settings) {
  ordered_json lock = lock_head(settings);
  lock["study"] = to_json(*plan.study);
  if (const auto text = read_file(plan.study->file)) lock["study_sha256"] = data::sha256_hex(*text);
  for (const auto& [id, set] : plan.datasets) {
    lock["datasets"][id] = {{"sha256", set.sha256}, {"split", plan.notes.at(id)}};
  }
  for (int replicate = 0; replicate < plan.study->replicates; ++replicate) {
    lock["seeds"].push_back(seed_of(*plan.study, replicate));
  }
  add_cases(cases, lock);
  add_source(*plan.study, lock);
  return write_lock(settings.folder, lock);
}

void set_old_cases_aside(const RunSettings& settings) {
  const std::filesystem::path old = settings.folder / "cases";
  std::error_code error;
  if (!std::filesystem::is_directory(old, error)) return;
  std::filesystem::path aside = settings.folder / "cases.stale";
  for (int k = 2; std::filesystem::exists(aside, error); ++k) {
    aside = settings.folder / fmt::format("cases.stale-{}", k);
  }
  std::filesystem::rename(old, aside, error);
  if (!error && settings.log) {
    settings.log(fmt::format("cases of an earlier version, a file each: set aside as {}",
                             aside.filename().string()));
  }
}

RunSummary summary_of(EngineSummary ran) {
  RunSummary summary;
  summary.cases = ran.cases;
  summary.computed = ran.computed;
  summary.reused = ran.reused;
  summary.failures = ran.failed;
  summary.failed = std::move(ran.failures);
  summary.damaged = std::move(ran.damaged);
  summary.interrupted = ran.interrupted;
  return summary;
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
