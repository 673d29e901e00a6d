#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "flexspline/core/error.hpp"
#include "flexspline/studies/engine.hpp"
#include "flexspline/studies/plan.hpp"

namespace flexspline::studies {

/// Where and how a study runs. The callbacks are called by one thread at a time.
struct RunSettings : EngineSettings {
  std::string build_id;                         ///< of the program
  std::map<std::string, std::string> versions;  ///< of program and libraries, for the lock file
};

/// What a run did.
struct RunSummary {
  std::size_t cases = 0;  ///< of the shard
  std::size_t computed = 0;
  std::size_t reused = 0;            ///< valid results of an earlier run
  std::size_t failures = 0;          ///< also of reused ones
  std::vector<std::string> failed;   ///< "key: reason", also of reused ones; at most kMostFailures
  std::vector<std::string> damaged;  ///< what was lost of an earlier run's journals
  bool interrupted = false;
  double seconds = 0.0;
};

/// Runs what the folder does not yet hold: inputs, cases, and where the study asks for it the
/// paper's facts. A case that fails becomes a result that says so, and the study goes on. Results
/// of cases that the study no longer has are set aside (run_cases).
/// Errors: cannot_write; bad_data where the folder was written by another version.
Result<RunSummary> run_study(const StudyPlan& plan, const RunSettings& settings);

}  // namespace flexspline::studies
