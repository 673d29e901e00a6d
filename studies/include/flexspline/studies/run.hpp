#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "flexspline/core/error.hpp"
#include "flexspline/studies/case_row.hpp"
#include "flexspline/studies/plan.hpp"

namespace flexspline::studies {

/// How far a run is.
struct Progress {
  std::size_t done = 0;
  std::size_t total = 0;
  std::size_t failed = 0;
  double seconds = 0.0;  ///< since the run began
};

/// Where and how a study runs. The callbacks are called by one thread at a time.
struct RunSettings {
  std::filesystem::path folder;
  int jobs = 0;                                 ///< workers; 0: as many as the machine has
  std::string build_id;                         ///< of the program
  std::map<std::string, std::string> versions;  ///< of program and libraries, for the lock file
  const std::atomic<bool>* stop = nullptr;  ///< becomes true: finish the cases at hand and return
  std::function<void(const Progress&)> progress;
  std::function<void(std::string_view)> log;
};

/// What a run did.
struct RunSummary {
  std::size_t cases = 0;
  std::size_t computed = 0;                  ///< cases
  std::size_t reused = 0;                    ///< valid artefacts of an earlier run
  std::vector<std::string> failed;           ///< "key: reason", also of reused ones
  std::vector<std::optional<CaseRow>> rows;  ///< a plan's case each; none of those that failed
  bool interrupted = false;
  double seconds = 0.0;
};

/// Runs what the folder does not yet hold: inputs, cases, and where the study asks for it the
/// paper's facts. A case that fails becomes an artefact that says so, and the study goes on.
/// Artefacts of cases that the study no longer has are set aside as <name>.stale.
/// Errors: cannot_write.
Result<RunSummary> run_study(const StudyPlan& plan, const RunSettings& settings);

/// How long the fit of each case took, s, by its key: seconds.csv of a study's folder. It lies
/// beside the cases, so that these are the same bytes in every run.
std::map<std::string, double> wall_times(const std::filesystem::path& folder);

}  // namespace flexspline::studies
