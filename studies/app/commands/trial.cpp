#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "diagnosis_engine.hpp"
#include "flexspline/reports/report.hpp"
#include "flexspline/studies/trial.hpp"
#include "run_folder.hpp"
#include "stop_signal.hpp"
#include "version.hpp"

namespace flexspline::app {
namespace {

using studies::TrialScores;

std::string rate_line(const TrialScores& scores, const char* name, const char* says) {
  const studies::Proportion one = scores.rate(name);
  if (one.of == 0) return {};
  return fmt::format("  {:<34} {:>4} of {:<4} {:5.1f} %  (95 %: {:.1f} to {:.1f})\n", says,
                     one.count, one.of, 100.0 * one.rate(), 100.0 * one.lower, 100.0 * one.upper);
}

std::string summary_of(const TrialScores& scores) {
  std::string text;
  text += rate_line(scores, "null_ok", "nothing hidden, called adequate");
  text += rate_line(scores, "single_top", "one effect, named first");
  text += rate_line(scores, "single_exact", "one effect, named exactly");
  text += rate_line(scores, "pair_all", "two effects, both named");
  text += rate_line(scores, "unknown_unnamed", "outside the catalogue, not named");
  text += rate_line(scores, "unknown_ok", "the same, and called unexplained");
  text += rate_line(scores, "contained_ok", "contained in the baseline, no false name");
  text += rate_line(scores, "coord_ok", "right coordinate among three");
  text += rate_line(scores, "false_name", "cases with a false name");
  const auto median = [&](const char* name, const char* says, const char* unit) {
    const double value = scores.median(name);
    if (value == value) text += fmt::format("  {:<34} {:.3g}{}\n", says, value, unit);
  };
  median("holdout_after_over_noise_median", "hold-out over noise, median", "");
  median("holdout_after_over_best_median", "hold-out over the best possible", "");
  median("seconds_median", "a diagnosis, median", " s");
  median("seconds_max", "a diagnosis, longest", " s");
  return text;
}

void show_progress(Console& console, const studies::Progress& progress) {
  const std::string text = fmt::format("{}/{} cases, {} failed, {:.0f} s", progress.done,
                                       progress.total, progress.failed, progress.seconds);
  console.live(text);
  const std::size_t tenth = std::max<std::size_t>(1, progress.total / 10);
  if (!console.is_terminal() && progress.done % tenth == 0) console.say(text);
}

studies::TrialSettings settings_of(const Arguments& arguments, long jobs, Console& console) {
  studies::TrialSettings settings;
  settings.run.folder = arguments.text("out");
  settings.run.jobs = static_cast<int>(jobs);
  settings.run.build_id = build_id() + arguments.text("engine") + arguments.text("interest");
  settings.run.versions = versions();
  settings.run.stop = &stop_requested();
  settings.run.progress = [&console](const studies::Progress& progress) {
    show_progress(console, progress);
  };
  settings.run.log = [&console](std::string_view text) { console.detail(text); };
  settings.recordings = arguments.text("recordings");
  return settings;
}

Result<ExitCode> show(const studies::TrialSummary& summary, const std::filesystem::path& folder,
                      Console& console) {
  for (const std::string& one : summary.not_concealed) console.say("not concealed: " + one);
  for (const std::string& one : summary.run.failed) console.error(one);
  const auto page = reports::write_report(folder);
  if (!page) return tl::unexpected(page.error());
  const TrialScores scores = studies::score_trial(summary.cases);
  if (console.json) {
    nlohmann::ordered_json text = {{"trial", (folder / "trial.json").string()},
                                   {"report", page->string()},
                                   {"cases", summary.run.cases},
                                   {"computed", summary.run.computed},
                                   {"reused", summary.run.reused},
                                   {"failed", summary.run.failed},
                                   {"seconds", summary.run.seconds},
                                   {"scores", nlohmann::ordered_json::object()}};
    for (const auto& [name, value] : scores.counters) text["scores"][name] = value;
    for (const auto& [name, value] : scores.medians) text["scores"][name] = value;
    console.result(text.dump(2));
  } else {
    console.say(summary_of(scores));
    console.result(page->string());
  }
  return summary.run.failed.empty() && summary.not_concealed.empty() ? kDone : kSomethingFailed;
}

Result<ExitCode> run(const Arguments& arguments, Console& console) {
  const Result<long> jobs = jobs_of(arguments);
  if (!jobs) return tl::unexpected(jobs.error());
  const auto trial = studies::load_trial(arguments.text("study"));
  if (!trial) return tl::unexpected(trial.error());
  catch_stop_signals();
  const studies::TrialSettings settings = settings_of(arguments, *jobs, console);
  const auto engine = engine_of(arguments, static_cast<int>(*jobs));
  if (!engine) return tl::unexpected(engine.error());
  const auto summary = studies::run_trial(*trial, settings, *engine);
  if (!summary) return tl::unexpected(summary.error());
  if (summary->run.interrupted) {
    return failure(ErrorCode::interrupted,
                   fmt::format("interrupted after {} of {} cases",
                               summary->run.computed + summary->run.reused, summary->run.cases),
                   "the same command goes on from here");
  }
  return show(*summary, settings.run.folder, console);
}

}  // namespace

CommandRow describe_trial() {
  return {
      .id = "trial",
      .summary = "Conceals many cases, diagnoses them blind, unseals and scores them",
      .arguments =
          {{.name = "study", .meaning = "trial file", .value = "STUDY.toml", .required = true},
           {.name = "--out",
            .meaning = "folder for cases, scores and tables",
            .value = "DIR",
            .required = true},
           {.name = "--jobs", .meaning = "cases at once; default: all processors", .value = "N"},
           engine_argument(),
           interest_argument(),
           {.name = "--recordings",
            .meaning = "keep every case's data set in this folder; "
                       "default: none is kept",
            .value = "DIR"}},
      .example = "flexspline trial studies/trial.toml --out out/trial",
      .run = run};
}

}  // namespace flexspline::app
