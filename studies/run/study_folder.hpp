#pragma once

#include <filesystem>
#include <set>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "flexspline/core/error.hpp"
#include "flexspline/studies/run.hpp"

namespace flexspline::studies {

/// Whether there is an artefact at a path, whole and dependent on exactly the same things.
bool is_valid(const std::filesystem::path& file, std::string_view schema,
              const std::string& depends_on);

/// What a lock begins with: schema, build, versions.
nlohmann::ordered_json lock_head(const RunSettings& settings);

/// How many cases there are; where they are few, each with what it depends on.
void add_cases(const CaseSource& cases, nlohmann::ordered_json& lock);

/// A path that means the same from every folder.
std::string lasting(const std::filesystem::path& path);

/// study.lock.toml. Errors: cannot_write.
Result<void> write_lock(const std::filesystem::path& folder, const nlohmann::ordered_json& lock);

/// The same of estimators on inputs: the configuration as understood, seeds, hashes.
Result<void> write_lock(const StudyPlan& plan, const CaseSource& cases,
                        const RunSettings& settings);

/// Renames cases of version 1, a file each: they are of another build in any case.
void set_old_cases_aside(const RunSettings& settings);

RunSummary summary_of(EngineSummary ran);

/// Renames every .json of a folder that is not in the list to <name>.stale, so that reports leave
/// it out and nothing is lost.
void set_aside(const std::filesystem::path& folder, const std::set<std::string>& kept,
               const RunSettings& settings);

}  // namespace flexspline::studies
