#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "command.hpp"
#include "flexspline/studies/run.hpp"

namespace flexspline::app {

/// What a command does with the cases as soon as they are written, before the report is drawn.
using WhenComputed = std::function<Result<void>(const studies::RunSummary&)>;

/// Where and how a command runs a study.
struct FolderRun {
  std::string command;
  std::filesystem::path folder;
  long jobs = 0;
  bool force = false;
  std::vector<std::filesystem::path> read{};  ///< beside the study file and its data sets
  WhenComputed when_computed{};
};

/// --out, --jobs and --force of the arguments. Errors: usage.
Result<FolderRun> folder_run(const Arguments& arguments, std::string command);

/// Plans and runs a study in a folder with progress on the console, then draws its report.
/// Gives what the run did; `report` is set to the page's path unless the run was interrupted.
/// Errors: of planning, cannot_write, interrupted, those of when_computed.
Result<studies::RunSummary> run_in_folder(const studies::StudyConfig& study, const FolderRun& run,
                                          Console& console, std::filesystem::path& report);

/// --jobs of the arguments; 0 where absent.
Result<long> jobs_of(const Arguments& arguments);

}  // namespace flexspline::app
