#include "run_folder.hpp"

#include <fmt/format.h>

#include "flexspline/core/write_file.hpp"
#include "flexspline/data/checksum.hpp"
#include "flexspline/reports/report.hpp"
#include "flexspline/studies/results.hpp"
#include "output_folder.hpp"
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

/// Everything that a study's folder may hold.
const std::vector<std::string>& study_files() {
  static const std::vector<std::string> names = {
      "study.lock.toml", "inputs",     "cases",      "paper.json",
      "results.nc",      "tables",     "report",     "ro-crate-metadata.json",
      "estimate.json",   "model.toml", "seconds.csv"};
  return names;
}

/// A study file is what it says; a study of one data set is that data set.
OutputWish wish_of(const studies::StudyPlan& plan, const FolderRun& run) {
  const studies::StudyConfig& study = *plan.study;
  OutputWish wish{run.command, run.folder, study.name, {}, study.file, run.read, run.force};
  for (const studies::InputConfig& input : study.inputs) {
    if (!input.dataset.empty()) wish.read.push_back(input.dataset);
  }
  if (!study.file.empty()) {
    wish.sha256 = data::sha256_hex(read_file(study.file).value_or(""));
    wish.read.push_back(study.file);
  } else if (!plan.datasets.empty()) {
    wish.sha256 = plan.datasets.begin()->second.sha256;
    wish.place = study.inputs.front().dataset;
  }
  return wish;
}

studies::RunSettings settings_of(const FolderRun& run, Console& console, ProgressLine& line) {
  studies::RunSettings settings;
  settings.folder = run.folder;
  settings.jobs = static_cast<int>(run.jobs);
  settings.build_id = build_id();
  settings.versions = versions();
  settings.stop = &stop_requested();
  settings.progress = [&line](const studies::Progress& progress) { line.show(progress); };
  settings.log = [&console](std::string_view text) { console.detail(text); };
  return settings;
}

}  // namespace

Result<FolderRun> folder_run(const Arguments& arguments, std::string command) {
  const Result<long> jobs = jobs_of(arguments);
  if (!jobs) return tl::unexpected(jobs.error());
  return FolderRun{std::move(command), arguments.text("out"), *jobs, arguments.has("force")};
}

Result<studies::RunSummary> run_in_folder(const studies::StudyConfig& study, const FolderRun& run,
                                          Console& console, std::filesystem::path& report) {
  const std::filesystem::path& folder = run.folder;
  const auto plan = studies::plan_study(study, build_id());
  if (!plan) return tl::unexpected(plan.error());
  auto output = OutputFolder::claim(wish_of(*plan, run));
  if (!output) return tl::unexpected(output.error());
  for (const auto& [input, note] : plan->notes) console.say(fmt::format("{}: {}", input, note));
  ProgressLine line(console);
  auto summary = studies::run_study(*plan, settings_of(run, console, line));
  if (!summary) return summary;
  if (summary->interrupted) {
    return failure(ErrorCode::interrupted,
                   fmt::format("interrupted after {} of {} cases",
                               summary->computed + summary->reused, summary->cases),
                   "the same command goes on from here");
  }
  say_what_was_done(*summary, console);
  if (run.when_computed) {
    if (const auto used = run.when_computed(*summary); !used) return tl::unexpected(used.error());
  }
  if (const auto written = studies::write_results(*plan, summary->rows, versions(), folder);
      !written) {
    return tl::unexpected(written.error());
  }
  if (const auto written = studies::write_ro_crate(*plan, versions(), folder); !written) {
    return tl::unexpected(written.error());
  }
  const auto page = reports::write_report(folder);
  if (!page) return tl::unexpected(page.error());
  report = page->page;
  if (auto done = output->finish(study_files()); !done) return tl::unexpected(done.error());
  return summary;
}

Result<long> jobs_of(const Arguments& arguments) { return arguments.integer("jobs", 0, 1, 1024); }

}  // namespace flexspline::app
