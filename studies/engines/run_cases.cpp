#include <algorithm>

#include "engines/case_queue.hpp"
#include "engines/running_note.hpp"
#include "flexspline/core/in_parallel.hpp"

namespace flexspline::studies {

Result<EngineSummary> run_cases(CaseSource& source, const EngineSettings& settings) {
  const std::size_t wanted = threads_for(static_cast<std::size_t>(std::max(0, settings.jobs)));
  CaseQueue queue(source, settings, wanted);
  if (settings.shard.whole()) remove_claims(settings.folder);
  const RunningNote note(settings.folder, settings.shard);
  if (const auto planned = queue.plan(note.who()); !planned) {
    return tl::unexpected(planned.error());
  }
  const std::size_t workers = std::min(wanted, queue.left());
  if (workers > 0) {
    note.write(queue.progress());
    EngineSettings watched = settings;
    watched.progress = [&](const Progress& state) {
      note.write(state);
      if (settings.progress) settings.progress(state);
    };
    (settings.limits.any() ? run_in_processes : run_in_threads)(queue, watched, workers);
  }
  if (settings.progress) settings.progress(queue.progress());
  return queue.summary();
}

}  // namespace flexspline::studies
