#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "dataset_study.hpp"
#include "error_text.hpp"
#include "fitted_rig.hpp"
#include "flexspline/data/dataset.hpp"
#include "flexspline/data/model_toml.hpp"
#include "output_folder.hpp"
#include "run_folder.hpp"
#include "servo_set.hpp"
#include "version.hpp"

namespace flexspline::app {
namespace {

using nlohmann::ordered_json;

/// The set with the roles that its recordings had in a case.
RecordingSet with_roles(RecordingSet set, const ordered_json& artefact) {
  for (const ordered_json& recording : artefact.at("recordings")) {
    const auto found =
        std::ranges::find(set.recordings, recording.at("id").get<std::string>(), &Recording::id);
    if (found == set.recordings.end()) continue;
    found->split = recording.at("role") == "holdout" ? Split::holdout : Split::train;
  }
  return set;
}

/// The estimate of a case with the errors in effort of every recording, train and hold-out.
ordered_json estimate_of(const ordered_json& artefact) {
  ordered_json estimate = artefact.at("estimate");
  const ordered_json roles = {{"train", ordered_json::object()},
                              {"holdout", ordered_json::object()}};
  for (const char* metric : {"rmse", "rmse_percent_of_peak", "outside_domain"}) {
    estimate[metric] = roles;
    for (const ordered_json& recording : artefact.at("recordings")) {
      estimate[metric][recording.at("role").get<std::string>()]
              [recording.at("id").get<std::string>()] = recording.at(metric);
    }
  }
  estimate["error_unit"] = artefact.at("units").at("effort");
  return estimate;
}

double samples_of(const Recording& recording) {
  const auto* valid = recording.find(Quantity::valid);
  if (valid == nullptr) return static_cast<double>(recording.time.size());
  return static_cast<double>(std::ranges::count_if(*valid, [](double v) { return v >= 0.5; }));
}

/// Root mean square over all samples that count, train and hold-out.
ordered_json pooled_of(const ordered_json& estimate, const RecordingSet& set) {
  ordered_json pooled = ordered_json::object();
  for (const char* role : {"train", "holdout"}) {
    double squares = 0.0;
    double count = 0.0;
    for (const auto& [id, value] : estimate.at("rmse").at(role).items()) {
      const auto found = std::ranges::find(set.recordings, id, &Recording::id);
      if (found == set.recordings.end() || value.is_null()) continue;
      squares += samples_of(*found) * std::pow(value.get<double>(), 2);
      count += samples_of(*found);
    }
    pooled[role] = count > 0.0 ? ordered_json(std::sqrt(squares / count)) : ordered_json(nullptr);
  }
  return pooled;
}

std::string pooled_line(const ordered_json& estimate, const char* role) {
  if (!estimate.contains("pooled_rmse")) return {};
  const auto& pooled = estimate.at("pooled_rmse").at(role);
  if (pooled.is_null()) return {};
  return fmt::format("\n  {:<8} {:<28} rmse {}", role, "all samples",
                     error_text(pooled, estimate.value("error_unit", ""), nullptr, false));
}

std::string summary_of(const ordered_json& estimate, const FittedRig& rig) {
  std::string text =
      fmt::format("{}: {}, {} parameters, {}", estimate.value("estimator", ""),
                  estimate.value("termination", ""), estimate.at("parameters").size(),
                  estimate.at("identifiability").value("says", ""));
  for (const char* role : {"train", "holdout"}) {
    for (const auto& [id, value] : estimate.at("rmse").at(role).items()) {
      text += fmt::format("\n  {:<8} {:<28} rmse {}", role, id,
                          error_text(value, estimate.value("error_unit", ""),
                                     estimate.at("rmse_percent_of_peak").at(role).at(id),
                                     estimate.at("outside_domain").at(role).at(id)));
    }
    text += pooled_line(estimate, role);
  }
  return text + text_of(rig) + notes_text(estimate.at("notes"));
}

/// Either an estimator of the catalogue or the form of a model file.
Result<studies::StudyConfig> study_of(const Arguments& arguments,
                                      const estimators::Options& options) {
  const std::string model = arguments.text("model");
  const std::string estimator = arguments.text("estimator", model.empty() ? "" : "model_file");
  if (estimator.empty() || (!model.empty() && estimator != "model_file")) {
    return failure(ErrorCode::usage,
                   estimator.empty() ? "neither --estimator nor --model is given"
                                     : "--estimator and --model are both given",
                   "give one: an id of flexspline list estimators, or a model file whose numbers "
                   "are starts");
  }
  const auto rows = rows_of(arguments);
  if (!rows) return tl::unexpected(rows.error());
  auto study = dataset_study(arguments.text("dataset"), {estimator}, arguments.text("train", "all"),
                             options);
  if (!study) return study;
  study->inputs.front().rows = *rows;
  const auto held = arguments.texts("holdout");
  if (held == std::vector<std::string>{"none"}) {
    study->inputs.front().held_out.emplace();
  } else if (!held.empty()) {
    study->inputs.front().held_out = held;
  }
  if (model.empty()) return study;
  auto read = data::read_model(model);
  if (!read) return tl::unexpected(read.error());
  study->estimators.front().model =
      estimators::GivenModel{std::move(*read), arguments.texts("hold"), arguments.texts("free")};
  return study;
}

/// Whether a model is fitted to a servo, which has options of its own.
bool on_servo(const Arguments& arguments) {
  if (arguments.text("model").empty()) return false;
  const auto set = data::load_dataset(arguments.text("dataset"));
  return set && set->rig == Rig::servo;
}

/// A model file on a servo's recordings; nothing where the set is another rig's.
std::optional<Result<ExitCode>> run_on_servo(const Arguments& arguments,
                                             const studies::StudyConfig& study,
                                             const estimators::Options& options, Console& console) {
  const auto& model = study.estimators.front().model;
  if (!model) return std::nullopt;
  auto set = data::load_dataset(arguments.text("dataset"), study.inputs.front().rows);
  if (!set || set->rig != Rig::servo) return std::nullopt;
  const std::filesystem::path dataset = arguments.text("dataset");
  auto output = OutputFolder::claim({"fit",
                                     arguments.text("out"),
                                     set->name,
                                     set->sha256,
                                     dataset,
                                     {dataset, arguments.text("model")},
                                     arguments.has("force")});
  if (!output) return tl::unexpected(output.error());
  const auto code = fit_servo_set(std::move(*set), *model, study.inputs.front().held_out, options,
                                  arguments.text("out"), console);
  if (!code) return code;
  return output->finish(std::vector<std::string>{"model.toml", "estimate.json"}).map([&] {
    return *code;
  });
}

Result<ExitCode> run(const Arguments& arguments, Console& console) {
  auto where = folder_run(arguments, "fit");
  if (!where) return tl::unexpected(where.error());
  if (arguments.has("model")) where->read.emplace_back(arguments.text("model"));
  const auto options = parse_options(arguments.texts("option"));
  if (!options) return tl::unexpected(options.error());
  const auto study = study_of(arguments, on_servo(arguments) ? estimators::Options{} : *options);
  if (!study) return tl::unexpected(study.error());
  if (auto servo = run_on_servo(arguments, *study, *options, console)) return *std::move(servo);
  const std::filesystem::path& folder = where->folder;
  const std::string key =
      fmt::format("{}--{}--r0", study->inputs.front().id, study->estimators.front().id);
  ordered_json estimate;
  FittedRig rig;
  // The estimate is what was asked for; drawing a report takes longer than many fits.
  where->when_computed = [&](const studies::RunSummary& summary) -> Result<void> {
    if (!summary.failed.empty()) return {};
    const auto stored = stored_case(folder, key);
    if (!stored) return tl::unexpected(stored.error());
    const auto artefact = ordered_json::parse(stored->artefact);
    estimate = estimate_of(artefact);
    estimate["seconds"] = stored->seconds;
    const auto set = data::load_dataset(arguments.text("dataset"), study->inputs.front().rows);
    if (!set) return tl::unexpected(set.error());
    if (study->estimators.front().model) estimate["pooled_rmse"] = pooled_of(estimate, *set);
    auto whole = fitted_rig(with_roles(*set, artefact), estimate);
    if (!whole) return tl::unexpected(whole.error());
    rig = std::move(*whole);
    return write_fit(folder, estimate, rig);
  };
  std::filesystem::path report;
  const auto planned = studies::plan_fits(*study, build_id());
  if (!planned) return tl::unexpected(planned.error());
  const auto summary = run_in_folder(**planned, *where, console, report);
  if (!summary) return tl::unexpected(summary.error());
  if (!summary->failed.empty()) return kSomethingFailed;
  console.result(console.json ? estimate.dump(2)
                              : summary_of(estimate, rig) + "\n" + report.string());
  return kDone;
}

}  // namespace

CommandRow describe_fit() {
  return {.id = "fit",
          .group = "Fit and diagnose",
          .summary =
              "One estimator, or the form of a model file, on one data set: DIR/estimate.json, "
              "DIR/model.toml and a report",
          .arguments = {{.name = "dataset",
                         .meaning = "folder of a data set",
                         .value = "DATASET",
                         .required = true},
                        {.name = "--estimator",
                         .meaning = "method, see flexspline list estimators",
                         .value = "ID"},
                        {.name = "--model",
                         .meaning = "instead: a model file whose form is fitted from its numbers",
                         .value = "MODEL.toml"},
                        {.name = "--hold",
                         .meaning = "with --model: a parameter, law, effect or .ending that stays",
                         .value = "NAME",
                         .repeats = true},
                        {.name = "--free",
                         .meaning = "with --model: one that is fitted though it would stay",
                         .value = "NAME",
                         .repeats = true},
                        {.name = "--holdout",
                         .meaning = "recordings to hold out instead of the automatic ones; or none",
                         .value = "ID",
                         .repeats = true},
                        {.name = "--option",
                         .meaning = "a setting of the method",
                         .value = "NAME=VALUE",
                         .repeats = true},
                        {.name = "--train",
                         .meaning = "all training recordings, or the one with the largest motion",
                         .value = "all|one"},
                        rows_argument(),
                        {.name = "--out",
                         .meaning = "folder for estimate and report",
                         .value = "DIR",
                         .required = true},
                        kForce,
                        {.name = "--jobs", .meaning = "workers", .value = "N"}},
          .example = "flexspline fit recordings/iiwa-j1 --estimator trajectory_ceres --out out/j1",
          .run = run};
}

}  // namespace flexspline::app
