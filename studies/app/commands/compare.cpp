#include <filesystem>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "dataset_study.hpp"
#include "error_text.hpp"
#include "flexspline/data/artefact.hpp"
#include "output_folder.hpp"
#include "run_folder.hpp"
#include "version.hpp"

namespace flexspline::app {
namespace {

using nlohmann::ordered_json;

std::vector<std::string> split_ids(const std::string& list) {
  std::vector<std::string> ids;
  std::istringstream stream(list);
  for (std::string id; std::getline(stream, id, ',');) {
    if (!id.empty()) ids.push_back(id);
  }
  return ids;
}

Result<ordered_json> case_of(const studies::StudyConfig& study,
                             const studies::EstimatorConfig& estimator,
                             const std::filesystem::path& folder) {
  const std::string key = fmt::format("{}--{}--r0", study.inputs.front().id, estimator.id);
  return stored_case(folder, key).map([](const StoredCase& one) {
    return ordered_json::parse(one.artefact);
  });
}

/// rmse in percent of peak by recording and estimator, as the cases say.
ordered_json table_of(const studies::StudyConfig& study, const std::filesystem::path& folder) {
  ordered_json rows = ordered_json::array();
  for (const studies::EstimatorConfig& estimator : study.estimators) {
    const auto artefact = case_of(study, estimator, folder);
    if (!artefact) continue;
    for (const ordered_json& recording : artefact->at("recordings")) {
      rows.push_back({{"estimator", estimator.id},
                      {"role", recording.at("role")},
                      {"recording", recording.at("id")},
                      {"rmse", recording.at("rmse")},
                      {"unit", artefact->at("units").at("effort")},
                      {"rmse_percent_of_peak", recording.at("rmse_percent_of_peak")},
                      {"outside_domain", recording.at("outside_domain")}});
    }
  }
  return rows;
}

std::string as_text(const ordered_json& rows) {
  std::string text = fmt::format("{:<24} {:<8} {:<28} {}", "estimator", "role", "recording",
                                 "rms error of torque (force)");
  for (const ordered_json& row : rows) {
    text += fmt::format("\n{:<24} {:<8} {:<28} {}", row.at("estimator").get<std::string>(),
                        row.at("role").get<std::string>(), row.at("recording").get<std::string>(),
                        error_text(row.at("rmse"), row.at("unit").get<std::string>(),
                                   row.at("rmse_percent_of_peak"), row.at("outside_domain")));
  }
  return text;
}

/// What the estimators say of their own results, "ID: note" each once.
std::string all_notes(const studies::StudyConfig& study, const std::filesystem::path& folder) {
  std::string text;
  for (const studies::EstimatorConfig& estimator : study.estimators) {
    const auto artefact = case_of(study, estimator, folder);
    if (!artefact || artefact->at("status") != "done") continue;
    const std::string notes = notes_text(artefact->at("estimate").at("notes"));
    if (!notes.empty()) text += "\n" + estimator.id + notes;
  }
  return text;
}

Result<ExitCode> run(const Arguments& arguments, Console& console) {
  const auto where = folder_run(arguments, "compare");
  if (!where) return tl::unexpected(where.error());
  const std::vector<std::string> ids = split_ids(arguments.text("estimators"));
  if (ids.empty()) return failure(ErrorCode::usage, "--estimators names none", "give ID,ID,…");
  const auto rows = rows_of(arguments);
  if (!rows) return tl::unexpected(rows.error());
  auto study = dataset_study(arguments.text("dataset"), ids, arguments.text("train", "all"), {});
  if (!study) return tl::unexpected(study.error());
  study->inputs.front().rows = *rows;
  std::filesystem::path report;
  const auto planned = studies::plan_fits(*study, build_id());
  if (!planned) return tl::unexpected(planned.error());
  const auto summary = run_in_folder(**planned, *where, console, report);
  if (!summary) return tl::unexpected(summary.error());
  const ordered_json table = table_of(*study, where->folder);
  console.result(console.json
                     ? table.dump(2)
                     : as_text(table) + all_notes(*study, where->folder) + "\n" + report.string());
  return summary->failed.empty() ? kDone : kSomethingFailed;
}

}  // namespace

CommandRow describe_compare() {
  return {.id = "compare",
          .group = "Fit and diagnose",
          .summary = "Several estimators on one data set, train and hold-out, side by side",
          .arguments = {{.name = "dataset",
                         .meaning = "folder of a data set",
                         .value = "DATASET",
                         .required = true},
                        {.name = "--estimators",
                         .meaning = "methods, see flexspline list estimators",
                         .value = "ID,ID,…",
                         .required = true},
                        {.name = "--train",
                         .meaning = "all training recordings, or the one with the largest motion",
                         .value = "all|one"},
                        {.name = "--out",
                         .meaning = "folder for artefacts and report",
                         .value = "DIR",
                         .required = true},
                        rows_argument(),
                        kForce,
                        {.name = "--jobs", .meaning = "workers", .value = "N"}},
          .example =
              "flexspline compare recordings/band-damper --estimators trajectory_ceres,bouc_wen "
              "--out out/damper",
          .run = run};
}

}  // namespace flexspline::app
