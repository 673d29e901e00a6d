#include <filesystem>
#include <map>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "flexspline/core/write_file.hpp"
#include "flexspline/data/checksum.hpp"
#include "flexspline/studies/trial.hpp"
#include "interest.hpp"
#include "output_folder.hpp"
#include "run_folder.hpp"
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
  text += rate_line(scores, "incident_ok", "inside one recording, placed");
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

/// Where there are several generators, the rates of each; then of all.
std::string summary_of(const studies::TrialSummary& summary) {
  std::map<std::string, std::vector<studies::ScoredCase>> groups;
  for (const auto& one : summary.cases) groups[one.answer.generator].push_back(one);
  std::string text;
  for (const auto& [generator, cases] : groups) {
    if (groups.size() > 1) text += generator + ":\n" + summary_of(studies::score_trial(cases));
  }
  if (groups.size() > 1) text += "together:\n";
  return text + summary_of(studies::score_trial(summary.cases));
}

ExitCode show(const studies::TrialSummary& summary, const studies::RunSummary& ran,
              const std::filesystem::path& folder, const std::filesystem::path& page,
              Console& console) {
  for (const std::string& one : summary.not_concealed) console.say("not concealed: " + one);
  const TrialScores scores = studies::score_trial(summary.cases);
  if (console.json) {
    nlohmann::ordered_json text = {{"trial", (folder / "trial.json").string()},
                                   {"report", page.string()},
                                   {"cases", ran.cases},
                                   {"computed", ran.computed},
                                   {"reused", ran.reused},
                                   {"failed", summary.run.failed},
                                   {"seconds", ran.seconds},
                                   {"scores", nlohmann::ordered_json::object()}};
    for (const auto& [name, value] : scores.counters) text["scores"][name] = value;
    for (const auto& [name, value] : scores.medians) text["scores"][name] = value;
    console.result(text.dump(2));
  } else {
    console.say(summary_of(summary));
    console.result(page.string());
  }
  return summary.run.failed.empty() && summary.not_concealed.empty() ? kDone : kSomethingFailed;
}

/// What lies in the trial's folder is the trial's alone.
Result<void> keep_apart(const std::filesystem::path& recordings, const std::filesystem::path& out) {
  std::error_code error;
  const auto inside = std::filesystem::weakly_canonical(recordings, error)
                          .lexically_relative(std::filesystem::weakly_canonical(out, error));
  if (inside.empty() || *inside.begin() == "..") return {};
  return failure(ErrorCode::usage,
                 fmt::format("--recordings {} lies in --out {}", recordings.string(), out.string()),
                 "choose a folder of its own beside it");
}

/// Claims the folder of the recordings, where they are to be kept.
Result<std::optional<OutputFolder>> keep_recordings(const studies::TrialConfig& trial,
                                                    const Arguments& arguments) {
  if (!arguments.has("recordings")) return std::nullopt;
  const auto apart = keep_apart(arguments.text("recordings"), arguments.text("out"));
  if (!apart) return tl::unexpected(apart.error());
  const auto text = read_file(trial.file);
  if (!text) return tl::unexpected(text.error());
  return OutputFolder::claim({"trial --recordings",
                              arguments.text("recordings"),
                              trial.name,
                              data::sha256_hex(*text),
                              trial.file,
                              {trial.file},
                              arguments.has("force")})
      .map([](OutputFolder&& kept) { return std::optional<OutputFolder>(std::move(kept)); });
}

Result<ExitCode> run(const Arguments& arguments, Console& console) {
  const auto where = folder_run(arguments, "trial");
  if (!where) return tl::unexpected(where.error());
  const auto trial = studies::load_trial(arguments.text("study"), arguments.text("data-root"));
  if (!trial) return tl::unexpected(trial.error());
  studies::TrialSettings settings;
  settings.run.build_id = build_id();
  settings.run.folder = where->folder;
  settings.recordings = arguments.text("recordings");
  const auto interest = interest_of(arguments);
  if (!interest) return tl::unexpected(interest.error());
  if (arguments.has("folds")) settings.diagnosis["folds"] = "outer";
  if (arguments.has("interest")) settings.diagnosis["interest"] = fmt::format("{}", *interest);
  auto recordings = keep_recordings(*trial, arguments);
  if (!recordings) return tl::unexpected(recordings.error());
  std::filesystem::path page;
  const auto ran =
      run_in_folder(*studies::plan_trial_study(*trial, settings), *where, console, page);
  if (!ran) return tl::unexpected(ran.error());
  const auto summary = studies::gather_trial(*trial, settings);
  if (!summary) return tl::unexpected(summary.error());
  return show(*summary, *ran, where->folder, page, console);
}

}  // namespace

CommandRow describe_trial() {
  return {
      .id = "trial",
      .group = "Simulated test cases",
      .summary = "Conceals many cases, diagnoses them blind, unseals and scores them",
      .arguments =
          {{.name = "study", .meaning = "trial file", .value = "STUDY.toml", .required = true},
           {.name = "--out",
            .meaning = "folder for cases, scores and tables",
            .value = "DIR",
            .required = true},
           kForce,
           {.name = "--jobs", .meaning = "cases at once; default: all processors", .value = "N"},
           {.name = "--data-root",
            .meaning = "folder of the data sets to splice into; default: the trial file's",
            .value = "DIR"},
           {.name = "--folds",
            .meaning = "search in outer folds, too, as 'diagnose' does; default: as with its "
                       "--quick",
            .value = ""},
           interest_argument(),
           {.name = "--recordings",
            .meaning = "keep every case's data set in this folder; "
                       "default: none is kept",
            .value = "DIR"}},
      .example = "flexspline trial studies/trial.toml --out out/trial",
      .run = run};
}

}  // namespace flexspline::app
