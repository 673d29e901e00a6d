#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "flexspline/core/error.hpp"
#include "flexspline/studies/run.hpp"

namespace flexspline::studies {

/// Whether there is an artefact at a path, whole and dependent on exactly the same things.
bool is_valid(const std::filesystem::path& file, std::string_view schema,
              const std::string& depends_on);

/// study.lock.toml: the configuration as understood, seeds, hashes, versions. Errors: cannot_write.
Result<void> write_lock(const StudyPlan& plan, const RunSettings& settings);

/// Renames every .json of a folder that is not in the list to <name>.stale, so that reports leave
/// it out and nothing is lost.
void set_aside(const std::filesystem::path& folder, const std::set<std::string>& kept,
               const RunSettings& settings);

}  // namespace flexspline::studies
