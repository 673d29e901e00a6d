#pragma once

#include "command.hpp"
#include "flexspline/studies/study_config.hpp"
#include "run_folder.hpp"

namespace flexspline::app {

/// Runs a study as a job array of Slurm in elements of ten seconds or more, by a pilot measured
/// here, and waits until it is gathered. Interrupted, it leaves the jobs alone.
/// Errors: of planning and of submit(); interrupted.
Result<ExitCode> run_on_slurm(const Arguments& arguments, const studies::PlannedStudy& study,
                              const FolderRun& run, Console& console);

}  // namespace flexspline::app
