#include "slurm_run.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

#include <fmt/format.h>

#include "flexspline/studies/slurm.hpp"
#include "flexspline/studies/status.hpp"
#include "stop_signal.hpp"

namespace flexspline::app {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr double kPilotSeconds = 2.0;
constexpr double kElementSeconds = 10.0;  // Slurm takes some 0.2 s to begin one
constexpr long kMostElements = 1000;

/// As many elements as give each of them ten seconds of work.
std::size_t elements_for(const studies::PlannedStudy& study, long processors, Console& console) {
  const studies::Pilot pilot = study.pilot(kPilotSeconds);
  const double seconds = pilot.seconds / static_cast<double>(processors);
  const double elements =
      std::clamp(seconds / kElementSeconds, 1.0,
                 static_cast<double>(std::min<std::size_t>(study.size(), kMostElements)));
  console.say(fmt::format("about {:.3g} s of work: {:.0f} elements", pilot.seconds, elements));
  return static_cast<std::size_t>(elements);
}

Result<studies::SlurmJob> job_of(const Arguments& arguments, const studies::PlannedStudy& study,
                                 const FolderRun& run, Console& console) {
  const auto given = arguments.integer("elements", 0, 1, 10'000);
  if (!given) return tl::unexpected(given.error());
  const long processors = std::max(1L, run.jobs);
  studies::SlurmJob job;
  job.folder = fs::absolute(run.folder);
  job.name = "flexspline-" + study.name();
  job.run = {fs::read_symlink("/proc/self/exe").string(),
             "run",
             fs::absolute(arguments.text("study")).string(),
             "--out",
             job.folder.string(),
             "--jobs",
             std::to_string(processors),
             "--yes-many"};
  for (const char* option : {"case-seconds", "case-memory"}) {
    if (!arguments.has(option)) continue;
    job.run.insert(job.run.end(), {std::string("--") + option, arguments.text(option)});
  }
  if (arguments.has("data-root")) {
    job.run.insert(job.run.end(),
                   {"--data-root", fs::absolute(arguments.text("data-root")).string()});
  }
  job.processors = static_cast<int>(processors);
  job.elements =
      *given > 0 ? static_cast<std::size_t>(*given) : elements_for(study, processors, console);
  job.options = arguments.texts("sbatch");
  return job;
}

/// Until the queue knows none of them any more.
Result<void> wait_for(const studies::SlurmIds& ids, const fs::path& folder, Console& console) {
  double next = 60.0;
  const auto begun = std::chrono::steady_clock::now();
  while (true) {
    for (int i = 0; i < 20 && !stop_requested(); ++i) std::this_thread::sleep_for(100ms);
    if (stop_requested()) {
      return failure(
          ErrorCode::interrupted,
          fmt::format("jobs {} and {} go on without being watched", ids.array, ids.gather),
          fmt::format("flexspline status {} says how far they are; scancel ends them",
                      folder.string()));
    }
    const auto queued = studies::in_queue(ids);
    if (!queued) return tl::unexpected(queued.error());
    if (!*queued) return {};
    const auto status = studies::status_of(folder);
    if (!status) continue;
    const std::string text =
        fmt::format("{}/{} cases, {} failed, {} elements running", status->done, status->cases,
                    status->failed, status->running.size());
    console.live(text);
    const std::chrono::duration<double> since = std::chrono::steady_clock::now() - begun;
    if (console.is_terminal() || since.count() < next) continue;
    next = since.count() + 60.0;
    console.say(text);
  }
}

}  // namespace

Result<ExitCode> run_on_slurm(const Arguments& arguments, const studies::PlannedStudy& study,
                              const FolderRun& run, Console& console) {
  const auto claimed = claim_for(study, run);
  if (!claimed) return tl::unexpected(claimed.error());
  const auto job = job_of(arguments, study, run, console);
  if (!job) return tl::unexpected(job.error());
  const auto ids = studies::submit(*job);
  if (!ids) return tl::unexpected(ids.error());
  console.say(fmt::format("array {} of {} elements, gathered by job {}", ids->array, job->elements,
                          ids->gather));
  if (const auto over = wait_for(*ids, run.folder, console); !over) {
    return tl::unexpected(over.error());
  }
  const auto status = studies::status_of(run.folder);
  if (!status) return tl::unexpected(status.error());
  for (const std::string& failed : status->failures) console.error(failed);
  console.result((run.folder / "report" / "index.html").string());
  return status->complete() && status->failed == 0 ? kDone : kSomethingFailed;
}

}  // namespace flexspline::app
