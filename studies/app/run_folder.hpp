#pragma once

#include <filesystem>
#include <functional>

#include "command.hpp"
#include "flexspline/studies/run.hpp"

namespace flexspline::app {

/// What a command does with the cases as soon as they are written, before the report is drawn.
using WhenComputed = std::function<Result<void>(const studies::RunSummary&)>;

/// Plans and runs a study in a folder with progress on the console, then draws its report.
/// Gives what the run did; `report` is set to the page's path unless the run was interrupted.
/// Errors: of planning, cannot_write, interrupted, those of when_computed.
Result<studies::RunSummary> run_in_folder(const studies::StudyConfig& study,
                                          const std::filesystem::path& folder, long jobs,
                                          Console& console, std::filesystem::path& report,
                                          const WhenComputed& when_computed = {});

/// --jobs of the arguments; 0 where absent.
Result<long> jobs_of(const Arguments& arguments);

}  // namespace flexspline::app
