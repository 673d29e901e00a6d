#include <filesystem>
#include <map>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "diagnosis_artefact.hpp"
#include "flexspline/core/write_file.hpp"
#include "flexspline/data/artefact.hpp"
#include "flexspline/data/checksum.hpp"
#include "flexspline/data/dataset.hpp"
#include "flexspline/reports/report.hpp"
#include "flexspline/studies/diagnosis_json.hpp"
#include "flexspline/studies/planned_study.hpp"
#include "flexspline/studies/verify.hpp"
#include "output_folder.hpp"
#include "run_folder.hpp"
#include "version.hpp"

namespace flexspline::app {
namespace {

namespace fs = std::filesystem;

studies::RunSettings settings_of(const fs::path& again, long jobs, Console& console) {
  studies::RunSettings settings = settings_in(again, jobs, console);
  settings.progress = [&console](const studies::Progress& progress) {
    console.live(text_of(progress));
  };
  return settings;
}

/// A second computation; or the verification that there was no use in one.
using Again = Result<std::optional<studies::Verification>>;

Again run_study_again(const Arguments& arguments, const studies::RunSettings& settings,
                      Console& console) {
  const fs::path folder = arguments.text("dir");
  const fs::path lock = folder / "study.lock.toml";
  if (!arguments.has("study") && !file_exists(lock) && file_exists(folder / "trial.json")) {
    return failure(ErrorCode::usage, "this trial's folder does not say which file it came from",
                   "add --study TRIAL.toml");
  }
  const std::string data_root = arguments.text("data-root");
  const auto study = arguments.has("study")
                         ? studies::plan_file(arguments.text("study"), data_root, build_id())
                         : studies::plan_locked(lock, data_root, build_id());
  if (!study) return tl::unexpected(study.error());
  if (auto other = studies::other_data(folder, (*study)->data()); !other.empty()) {
    return studies::verify_on_other_data(folder, std::move(other));
  }
  const auto summary = (*study)->run(settings);
  if (!summary) return tl::unexpected(summary.error());
  for (const std::string& failed : summary->failed) console.detail(failed);
  if (summary->interrupted) {
    return failure(ErrorCode::interrupted, "interrupted; nothing was compared",
                   "the same command begins anew");
  }
  const auto answered = (*study)->gather(settings.folder, settings, true);
  if (!answered) return tl::unexpected(answered.error());
  return std::nullopt;
}

/// How a diagnosis was asked for.
Result<studies::DiagnosisSettings> settings_of_diagnosis(const fs::path& folder) {
  const auto artefact = data::read_artefact(folder / "diagnosis.json", studies::kDiagnosisSchema);
  if (!artefact) return tl::unexpected(artefact.error());
  studies::DiagnosisSettings settings{
      .holdout = artefact->value(nlohmann::ordered_json::json_pointer("/holdout/recordings"),
                                 std::vector<std::string>{}),
      .nested = !artefact->value("quick", false)};
  const auto interest = artefact->find("interest");
  if (interest != artefact->end() && interest->is_number()) settings.interest = *interest;
  return settings;
}

Again diagnose_again(const Arguments& arguments, const fs::path& again) {
  if (!arguments.has("dataset")) {
    return failure(ErrorCode::usage, "a diagnosis does not say where its recordings lie",
                   "add --dataset DATASET");
  }
  const auto recordings = data::load_dataset(arguments.text("dataset"));
  if (!recordings) return tl::unexpected(recordings.error());
  const fs::path folder = arguments.text("dir");
  auto other = studies::other_data(folder, {{"recordings", recordings->sha256}});
  if (!other.empty()) return studies::verify_on_other_data(folder, std::move(other));
  const auto asked = settings_of_diagnosis(folder);
  if (!asked) return tl::unexpected(asked.error());
  const auto diagnosis = studies::diagnose(*recordings, {}, *asked);
  if (!diagnosis) return tl::unexpected(diagnosis.error());
  return data::write_artefact(again / "diagnosis.json", diagnosis_artefact(*diagnosis))
      .map([]() -> std::optional<studies::Verification> { return std::nullopt; });
}

/// What the folder says, computed once more into another one.
Again run_again(const Arguments& arguments, const fs::path& again, Console& console) {
  const fs::path folder = arguments.text("dir");
  const Result<long> jobs = jobs_of(arguments);
  if (!jobs) return tl::unexpected(jobs.error());
  std::error_code ignored;
  fs::remove_all(again, ignored);
  const studies::RunSettings settings = settings_of(again, *jobs, console);
  if (file_exists(folder / "diagnosis.json")) return diagnose_again(arguments, again);
  return run_study_again(arguments, settings, console);
}

std::string text_of(const studies::Verification& verification) {
  std::string text = fmt::format("{}: {}", name_of(verification.level), verification.says);
  for (const studies::Circumstance& one : verification.changed) {
    text += fmt::format("\n  {:<13} {}: {} -> {}", one.kind, one.name, one.before, one.after);
  }
  for (const studies::ArtefactCheck& one : verification.artefacts) {
    if (one.level <= studies::Agreement::numeric) continue;
    text += fmt::format("\n  {:<13} {}", name_of(one.level), one.artefact);
    if (!one.reason.empty()) text += ": " + one.reason;
    if (one.worst.empty()) continue;
    const studies::Difference& worst = one.worst.front();
    text += fmt::format(": {} {} -> {}", worst.where, worst.before, worst.after);
  }
  return text;
}

/// Its own folder alone: the second run in it is removed before a third.
Result<OutputFolder> claim_for(const Arguments& arguments, const fs::path& out) {
  const fs::path folder = arguments.text("dir");
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    return failure(ErrorCode::input_missing, fmt::format("there is no folder {}", folder.string()),
                   "give the folder that run, fit, compare, diagnose or trial wrote");
  }
  const std::string place = fs::canonical(folder, error).string();
  OutputWish wish{"verify", out, folder.filename().string(), data::sha256_hex(place), folder, {}};
  if (out != folder / "verification") wish.read.push_back(folder);
  for (const char* one : {"study", "dataset", "against"}) {
    if (arguments.has(one)) wish.read.emplace_back(arguments.text(one));
  }
  return OutputFolder::claim(wish);
}

Result<studies::Verification> verified(const Arguments& arguments, const fs::path& out,
                                       Console& console) {
  const fs::path folder = arguments.text("dir");
  if (arguments.has("against")) {
    return studies::verify_folders(folder, arguments.text("against"));
  }
  auto done = run_again(arguments, out / "again", console);
  if (!done) return tl::unexpected(done.error());
  if (*done) return **std::move(done);
  return studies::verify_folders(folder, out / "again");
}

Result<ExitCode> run(const Arguments& arguments, Console& console) {
  const fs::path folder = arguments.text("dir");
  const fs::path out = arguments.text("out", (folder / "verification").string());
  auto output = claim_for(arguments, out);
  if (!output) return tl::unexpected(output.error());
  const auto verification = verified(arguments, out, console);
  if (!verification) return tl::unexpected(in_context(verification.error(), "verify"));
  const auto json = to_json(*verification);
  if (auto written = data::write_artefact(out / "verification.json", json); !written) {
    return tl::unexpected(written.error());
  }
  const auto page = reports::write_report(out);
  if (!page) return tl::unexpected(page.error());
  const std::vector<std::string> files = {"verification.json", "index.html", "report", "tables",
                                          "again"};
  if (auto done = output->finish(files); !done) return tl::unexpected(done.error());
  console.result(console.json ? json.dump(2) : text_of(*verification) + "\n" + page->page.string());
  return verification->holds() ? kDone : kSomethingFailed;
}

}  // namespace

CommandRow describe_verify() {
  return {
      .id = "verify",
      .group = "Fit and diagnose",
      .summary =
          "Reproducibility check: computes a folder again and compares, bitwise, numerically and "
          "statistically, with a reason for each difference",
      .arguments =
          {{.name = "dir",
            .meaning = "folder of a run, fit, comparison, diagnosis or trial",
            .value = "DIR",
            .required = true},
           {.name = "--against",
            .meaning = "compare with this folder instead of computing again",
            .value = "OTHER"},
           {.name = "--study",
            .meaning = "study or trial file; default: what study.lock.toml holds",
            .value = "STUDY.toml"},
           {.name = "--dataset", .meaning = "recordings of a diagnosis", .value = "DATASET"},
           {.name = "--data-root",
            .meaning = "where relative data-set paths start, if not here",
            .value = "DIR"},
           {.name = "--out",
            .meaning = "folder for the second run and the page; default: DIR/verification",
            .value = "DIR"},
           {.name = "--jobs", .meaning = "cases at once; default: all processors", .value = "N"}},
      .example = "flexspline verify out/paper",
      .run = run};
}

}  // namespace flexspline::app
