#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>

#include "flexspline/core/error.hpp"
#include "flexspline/studies/run.hpp"

namespace flexspline::studies {

/// What an artefact of an earlier run says, as far as a later run asks.
struct Earlier {
  bool failed = false;
  std::string reason;
  std::optional<CaseRow> row;  ///< of a case that did not fail
};

/// The artefact at a path, if it is whole and depends on exactly the same things.
std::optional<Earlier> find_valid(const std::filesystem::path& file, std::string_view schema,
                                  const std::string& depends_on);

/// study.lock.toml: the configuration as understood, seeds, hashes, versions. Errors: cannot_write.
Result<void> write_lock(const StudyPlan& plan, const RunSettings& settings);

/// Renames every .json of a folder that is not in the list to <name>.stale, so that reports leave
/// it out and nothing is lost.
void set_aside(const std::filesystem::path& folder, const std::set<std::string>& kept,
               const RunSettings& settings);

}  // namespace flexspline::studies
