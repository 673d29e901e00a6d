#include <cmath>
#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "dataset_study.hpp"
#include "diagnosis_artefact.hpp"
#include "flexspline/data/artefact.hpp"
#include "flexspline/data/dataset.hpp"
#include "flexspline/data/model_toml.hpp"
#include "flexspline/reports/report.hpp"
#include "stop_signal.hpp"

namespace flexspline::app {
namespace {

using studies::Diagnosis;

/// Nothing has been written while a diagnosis runs: where it is to stop, it is dropped.
studies::DiagnosisProgress progress_on(Console& console) {
  return [&console](double share, std::string_view stage) {
    if (stop_requested()) {
      console.error("interrupted; nothing was written");
      std::_Exit(static_cast<int>(ErrorCode::interrupted));
    }
    const std::string text = fmt::format("{:3.0f} %  {}", 100.0 * share, stage);
    console.live(text);
    if (!console.is_terminal()) console.detail(text);
  };
}

/// The contract's exit code of numerics that failed is that of a defect.
Error as_reported(Error error) {
  if (error.code == ErrorCode::numerics) error.code = ErrorCode::defect;
  return in_context(std::move(error), "diagnose");
}

Result<std::filesystem::path> write_diagnosis(const Diagnosis& diagnosis,
                                              const std::filesystem::path& folder) {
  const auto written =
      data::write_artefact(folder / "diagnosis.json", diagnosis_artefact(diagnosis));
  if (!written) return tl::unexpected(written.error());
  if (diagnosis.model) {
    const auto model = data::write_model(folder / "model.toml", *diagnosis.model);
    if (!model) return tl::unexpected(model.error());
  } else {
    std::error_code ignored;  // a model of an earlier run would contradict this one
    std::filesystem::remove(folder / "model.toml", ignored);
  }
  return reports::write_report(folder);
}

std::string number(double value, const char* unit = "") {
  return std::isfinite(value) ? fmt::format("{:.3g}{}", value, unit) : std::string("-");
}

std::string cause_line(const studies::Cause& cause) {
  std::string line = fmt::format(
      "\n  {:<28} {:>7} {:>12} {:>10}  {}", cause.effect, number(100.0 * cause.size_fraction, " %"),
      number(cause.probability), number(cause.evidence.holdout_rmse_ratio), cause.equation);
  if (!cause.alternatives.empty()) {
    line += fmt::format("\n    on these recordings it could as well be {}",
                        fmt::join(cause.alternatives, " or "));
  }
  return line;
}

std::string summary_of(const Diagnosis& diagnosis) {
  std::string text = fmt::format("{}: {}", name_of(diagnosis.verdict), diagnosis.says);
  if (!diagnosis.causes.empty()) {
    text += fmt::format("\n  {:<28} {:>7} {:>12} {:>10}  {}", "left out", "size", "probability",
                        "hold-out", "equation");
  }
  for (const studies::Cause& cause : diagnosis.causes) text += cause_line(cause);
  for (const studies::Mismatch& mismatch : diagnosis.mismatch) {
    text += fmt::format("\n  it differs in {} ({}): {}", mismatch.coordinate, mismatch.recording,
                        mismatch.says);
  }
  if (diagnosis.next_experiment) text += "\n  next: " + diagnosis.next_experiment->says;
  return text;
}

Result<ExitCode> run(const Arguments& arguments, Console& console) {
  const auto rows = rows_of(arguments);
  if (!rows) return tl::unexpected(rows.error());
  const auto recordings = data::load_dataset(arguments.text("dataset"), *rows);
  if (!recordings) return tl::unexpected(recordings.error());
  for (const std::string& note : recordings->notes) console.say(note);
  catch_stop_signals();
  const auto diagnosis = studies::diagnose(*recordings, progress_on(console));
  if (!diagnosis) return tl::unexpected(as_reported(diagnosis.error()));
  console.say(
      fmt::format("{} recordings, {:.1f} s", recordings->recordings.size(), diagnosis->seconds));
  const auto page = write_diagnosis(*diagnosis, arguments.text("out"));
  if (!page) return tl::unexpected(page.error());
  console.result(console.json ? diagnosis_artefact(*diagnosis).dump(2)
                              : summary_of(*diagnosis) + "\n" + page->string());
  return kDone;
}

}  // namespace

CommandRow describe_diagnose() {
  return {.id = "diagnose",
          .summary =
              "Where model and recordings differ: locates it, names what was left out, "
              "models it and proves it on hold-out",
          .arguments = {{.name = "dataset",
                         .meaning = "folder of a data set",
                         .value = "DATASET",
                         .required = true},
                        {.name = "--out",
                         .meaning = "folder for diagnosis.json, model.toml and the report",
                         .value = "DIR",
                         .required = true},
                        rows_argument()},
          .example = "flexspline diagnose recordings/band-damper --out out/damper",
          .run = run};
}

}  // namespace flexspline::app
