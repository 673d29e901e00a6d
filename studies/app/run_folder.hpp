#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "command.hpp"
#include "flexspline/core/case_store.hpp"
#include "flexspline/studies/planned_study.hpp"

namespace flexspline::app {

/// What a command does with the cases as soon as they are written, before the report is drawn.
using WhenComputed = std::function<Result<void>(const studies::RunSummary&)>;

/// Where and how a command runs a study.
struct FolderRun {
  std::string command;
  std::filesystem::path folder;
  long jobs = 0;
  bool force = false;
  studies::Shard shard{};
  bool pulls = false;  ///< takes packs from what is left, instead of the shard's own part
  studies::CaseLimits limits{};
  bool gather = false;    ///< computes nothing: results and report of the cases that are there
  bool yes_many = false;  ///< however many cases there are
  std::vector<std::filesystem::path> read{};  ///< beside the study file and its data sets
  WhenComputed when_computed{};
};

/// --out, --jobs and --force of the arguments. Errors: usage.
Result<FolderRun> folder_run(const Arguments& arguments, std::string command);

/// Runs a study in a folder with progress on the console, then draws its report.
/// Gives what the run did; `report` is set to the page's path unless the run was interrupted or is
/// one shard of several, which leave results and report to who gathers them.
/// Errors: usage, cannot_write, interrupted, those of when_computed.
Result<studies::RunSummary> run_in_folder(const studies::PlannedStudy& study, const FolderRun& run,
                                          Console& console, std::filesystem::path& report);

/// Refuses what is too much, and claims the folder for a study. Errors: usage, cannot_write.
Result<void> claim_for(const studies::PlannedStudy& study, const FolderRun& run);

/// Settings of a run in that folder, without progress. Callbacks log to the console.
studies::RunSettings settings_in(const std::filesystem::path& folder, long jobs, Console& console);

/// One case of a study's folder. Errors: of CaseStore.
Result<StoredCase> stored_case(const std::filesystem::path& folder, std::string_view key);

/// Says how far a run is: a live line on a terminal, else a line a minute.
class ProgressLine {
 public:
  explicit ProgressLine(Console& console) : console_(&console) {}
  void show(const studies::Progress& progress);

 private:
  Console* console_;
  double next_ = 60.0;  ///< s
};

/// "12/80 cases, 1 failed, 3.4/s, 20 s left; slowest now: a--b--r0, 5 s".
std::string text_of(const studies::Progress& progress);

/// --jobs of the arguments; 0 where absent.
Result<long> jobs_of(const Arguments& arguments);

}  // namespace flexspline::app
