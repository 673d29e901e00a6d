#include "run_folder.hpp"

#include <fmt/format.h>

#include "flexspline/core/write_file.hpp"
#include "flexspline/data/checksum.hpp"
#include "flexspline/reports/report.hpp"
#include "output_folder.hpp"
#include "stop_signal.hpp"
#include "version.hpp"

namespace flexspline::app {
namespace {

constexpr std::size_t kMany = 100'000;  // cases that nobody asks for by mistake

void say_what_was_done(const studies::RunSummary& summary, Console& console) {
  console.say(fmt::format("{} cases: {} computed, {} taken over, {} failed, {:.1f} s",
                          summary.cases, summary.computed, summary.reused, summary.failures,
                          summary.seconds));
  for (const std::string& lost : summary.damaged) {
    console.say(fmt::format("{}: computed again", lost));
  }
  for (const std::string& failed : summary.failed) console.error(failed);
}

/// Everything that a study's folder may hold.
const std::vector<std::string>& study_files() {
  static const std::vector<std::string> names = {"study.lock.toml",
                                                 "inputs",
                                                 "journals",
                                                 "commitments",
                                                 "paper.json",
                                                 "kind.json",
                                                 "trial.json",
                                                 "results.nc",
                                                 "tables",
                                                 "report",
                                                 "ro-crate-metadata.json",
                                                 "estimate.json",
                                                 "model.toml"};
  return names;
}

/// A study file is what it says; a study of one data set is that data set.
OutputWish wish_of(const studies::PlannedStudy& study, const FolderRun& run) {
  const bool trial = study.kind() == "trial";  // whichever of the two commands runs it
  OutputWish wish{trial ? "trial" : run.command,
                  run.folder,
                  study.name(),
                  {},
                  study.file(),
                  run.read,
                  run.force};
  for (const std::filesystem::path& one : study.reads()) wish.read.push_back(one);
  const auto sums = study.data();
  if (!study.file().empty()) {
    wish.differs = studies::differences_from(run.folder, study);
    wish.sha256 = data::sha256_hex(read_file(study.file()).value_or(""));
    wish.read.push_back(study.file());
  } else if (!sums.empty()) {
    wish.sha256 = sums.begin()->second;
    wish.place = study.reads().front();
  }
  return wish;
}

studies::RunSettings settings_of(const FolderRun& run, Console& console, ProgressLine& line) {
  studies::RunSettings settings = settings_in(run.folder, run.jobs, console);
  settings.shard = run.shard;
  settings.pulling.on = run.pulls;
  settings.limits = run.limits;
  settings.progress = [&line](const studies::Progress& progress) { line.show(progress); };
  return settings;
}

}  // namespace

studies::RunSettings settings_in(const std::filesystem::path& folder, long jobs, Console& console) {
  studies::RunSettings settings;
  settings.folder = folder;
  settings.jobs = static_cast<int>(jobs);
  settings.build_id = build_id();
  settings.versions = versions();
  settings.stop = &stop_requested();
  settings.log = [&console](std::string_view text) { console.detail(text); };
  return settings;
}

Result<FolderRun> folder_run(const Arguments& arguments, std::string command) {
  const Result<long> jobs = jobs_of(arguments);
  if (!jobs) return tl::unexpected(jobs.error());
  FolderRun run;
  run.command = std::move(command);
  run.folder = arguments.text("out");
  run.jobs = *jobs;
  run.force = arguments.has("force");
  return run;
}

namespace {

Result<void> refuse_many(const studies::PlannedStudy& study, const FolderRun& run) {
  if (study.size() <= kMany || run.yes_many) return {};
  return failure(
      ErrorCode::usage, fmt::format("the study has {} cases", study.size()),
      fmt::format("flexspline plan says how long they take; more than {} need --yes-many", kMany));
}

/// What would be reused, were the cases of the folder all of the study.
Result<studies::RunSummary> only_gathered(const studies::PlannedStudy& study,
                                          const std::filesystem::path& folder) {
  auto summary = study.done(folder);
  if (!summary) return summary;
  const std::size_t missing = study.size() - std::min(study.size(), summary->reused);
  if (missing > 0) summary->failed.push_back(fmt::format("{} cases are not there", missing));
  return summary;
}

Result<studies::RunSummary> computed(const studies::PlannedStudy& study, const FolderRun& run,
                                     Console& console) {
  if (run.gather) return only_gathered(study, run.folder);
  ProgressLine line(console);
  auto summary = study.run(settings_of(run, console, line));
  if (summary && summary->interrupted) {
    return failure(ErrorCode::interrupted,
                   fmt::format("interrupted after {} of {} cases",
                               summary->computed + summary->reused, summary->cases),
                   "the same command goes on from here");
  }
  return summary;
}

}  // namespace

Result<void> claim_for(const studies::PlannedStudy& study, const FolderRun& run) {
  if (auto few = refuse_many(study, run); !few) return few;
  const auto output = OutputFolder::claim(wish_of(study, run));
  if (!output) return tl::unexpected(output.error());
  // Scripts and what they say lie there before anything else does.
  return write_file(run.folder / "slurm" / "README", "Scripts and output of the job array.\n");
}

std::string text_of(const studies::Progress& progress) {
  std::string text =
      fmt::format("{}/{} cases, {} failed", progress.done, progress.total, progress.failed);
  if (progress.per_second > 0.0) {
    const double left = static_cast<double>(progress.total - progress.done) / progress.per_second;
    text += fmt::format(", {:.3g}/s, {:.0f} s left", progress.per_second, left);
  }
  if (!progress.slowest.empty() && progress.slowest_for >= 1.0) {
    text += fmt::format("; slowest now: {}, {:.0f} s", progress.slowest, progress.slowest_for);
  }
  return text;
}

void ProgressLine::show(const studies::Progress& progress) {
  if (console_->is_terminal()) return console_->live(text_of(progress));
  if (progress.seconds < next_) return;
  next_ = progress.seconds + 60.0;
  console_->say(text_of(progress));
}

Result<studies::RunSummary> run_in_folder(const studies::PlannedStudy& study, const FolderRun& run,
                                          Console& console, std::filesystem::path& report) {
  if (const auto few = refuse_many(study, run); !few) return tl::unexpected(few.error());
  auto output = OutputFolder::claim(wish_of(study, run));
  if (!output) return tl::unexpected(output.error());
  const auto differs = studies::differences_from(run.folder, study);
  for (const std::string& one : differs.value_or(std::vector<std::string>())) {
    console.say(fmt::format("edited since {} was computed: {}", run.folder.string(), one));
  }
  for (const std::string& input : studies::changed_data(run.folder, study)) {
    console.say(
        fmt::format("{}: its data set has changed since {} was computed: its cases are computed "
                    "again, the earlier ones set aside",
                    input, run.folder.string()));
  }
  for (const auto& [input, note] : study.notes()) console.say(fmt::format("{}: {}", input, note));
  auto summary = computed(study, run, console);
  if (!summary) return summary;
  say_what_was_done(*summary, console);
  if (!run.shard.whole()) return summary;
  if (run.when_computed) {
    if (const auto used = run.when_computed(*summary); !used) return tl::unexpected(used.error());
  }
  const auto gathered = study.gather(run.folder, settings_in(run.folder, run.jobs, console));
  if (!gathered) return tl::unexpected(gathered.error());
  const auto page = reports::write_report(run.folder);
  if (!page) return tl::unexpected(page.error());
  report = page->page;
  studies::remove_claims(run.folder);
  if (auto done = output->finish(study_files()); !done) return tl::unexpected(done.error());
  return summary;
}

Result<StoredCase> stored_case(const std::filesystem::path& folder, std::string_view key) {
  return CaseStore::open(folder).and_then([&](const CaseStore& store) { return store.read(key); });
}

Result<long> jobs_of(const Arguments& arguments) { return arguments.integer("jobs", 0, 1, 1024); }

}  // namespace flexspline::app
