#include <nlohmann/json.hpp>

#include "command.hpp"
#include "flexspline/studies/study_config.hpp"
#include "output_folder.hpp"
#include "run_folder.hpp"

namespace flexspline::app {
namespace {

Result<ExitCode> run(const Arguments& arguments, Console& console) {
  const auto where = folder_run(arguments, "run");
  if (!where) return tl::unexpected(where.error());
  const auto study = studies::load_study(arguments.text("study"), arguments.text("data-root"));
  if (!study) return tl::unexpected(study.error());
  std::filesystem::path report;
  const auto summary = run_in_folder(*study, *where, console, report);
  if (!summary) return tl::unexpected(summary.error());
  if (console.json) {
    const nlohmann::ordered_json text = {
        {"report", report.string()}, {"cases", summary->cases},   {"computed", summary->computed},
        {"reused", summary->reused}, {"failed", summary->failed}, {"seconds", summary->seconds}};
    console.result(text.dump(2));
  } else {
    console.result(report.string());
  }
  return summary->failed.empty() ? kDone : kSomethingFailed;
}

}  // namespace

CommandRow describe_run() {
  return {
      .id = "run",
      .summary = "Runs a study: plan, cases, comparison, report; goes on where it stopped",
      .arguments =
          {{.name = "study", .meaning = "study file", .value = "STUDY.toml", .required = true},
           {.name = "--out",
            .meaning = "folder for artefacts and report",
            .value = "DIR",
            .required = true},
           kForce,
           {.name = "--jobs", .meaning = "cases at once; default: all processors", .value = "N"},
           {.name = "--data-root",
            .meaning = "where relative data-set paths start; default: the study file's folder",
            .value = "DIR"}},
      .example = "flexspline run studies/paper.toml --out out/paper",
      .run = run};
}

}  // namespace flexspline::app
