#include "run_folder.hpp"

#include <fmt/format.h>

#include "flexspline/reports/report.hpp"
#include "flexspline/studies/results.hpp"
#include "stop_signal.hpp"
#include "version.hpp"

namespace flexspline::app {
namespace {

/// A live line on a terminal, else one line for every tenth of the way.
class ProgressLine {
 public:
  explicit ProgressLine(Console& console) : console_(&console) {}

  void show(const studies::Progress& progress) {
    const std::string text = fmt::format("{}/{} cases, {} failed, {:.1f} s", progress.done,
                                         progress.total, progress.failed, progress.seconds);
    console_->live(text);
    const std::size_t tenth = 10 * progress.done / std::max<std::size_t>(1, progress.total);
    if (!console_->is_terminal() && tenth > tenth_) console_->say(text);
    tenth_ = tenth;
  }

 private:
  Console* console_;
  std::size_t tenth_ = 0;
};

void say_what_was_done(const studies::RunSummary& summary, Console& console) {
  console.say(fmt::format("{} cases: {} computed, {} taken over, {} failed, {:.1f} s",
                          summary.cases, summary.computed, summary.reused, summary.failed.size(),
                          summary.seconds));
  for (const std::string& failed : summary.failed) console.error(failed);
}

}  // namespace

Result<studies::RunSummary> run_in_folder(const studies::StudyConfig& study,
                                          const std::filesystem::path& folder, long jobs,
                                          Console& console, std::filesystem::path& report,
                                          const WhenComputed& when_computed) {
  const auto plan = studies::plan_study(study, build_id());
  if (!plan) return tl::unexpected(plan.error());
  for (const auto& [input, note] : plan->notes) console.say(fmt::format("{}: {}", input, note));
  catch_stop_signals();
  ProgressLine line(console);
  studies::RunSettings settings;
  settings.folder = folder;
  settings.jobs = static_cast<int>(jobs);
  settings.build_id = build_id();
  settings.versions = versions();
  settings.stop = &stop_requested();
  settings.progress = [&](const studies::Progress& progress) { line.show(progress); };
  settings.log = [&](std::string_view text) { console.detail(text); };
  auto summary = studies::run_study(*plan, settings);
  if (!summary) return summary;
  if (summary->interrupted) {
    return failure(ErrorCode::interrupted,
                   fmt::format("interrupted after {} of {} cases",
                               summary->computed + summary->reused, summary->cases),
                   "the same command goes on from here");
  }
  say_what_was_done(*summary, console);
  if (when_computed) {
    if (const auto used = when_computed(*summary); !used) return tl::unexpected(used.error());
  }
  if (const auto written = studies::write_results(*plan, summary->rows, folder); !written) {
    return tl::unexpected(written.error());
  }
  if (const auto written = studies::write_ro_crate(*plan, versions(), folder); !written) {
    return tl::unexpected(written.error());
  }
  const auto page = reports::write_report(folder);
  if (!page) return tl::unexpected(page.error());
  report = *page;
  return summary;
}

Result<long> jobs_of(const Arguments& arguments) { return arguments.integer("jobs", 0, 1, 1024); }

}  // namespace flexspline::app
