#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "dataset_study.hpp"
#include "diagnosis_artefact.hpp"
#include "diagnosis_summary.hpp"
#include "flexspline/data/artefact.hpp"
#include "flexspline/data/dataset.hpp"
#include "flexspline/data/model_toml.hpp"
#include "flexspline/reports/report.hpp"
#include "interest.hpp"
#include "output_folder.hpp"

namespace flexspline::app {
namespace {

using studies::Diagnosis;

studies::DiagnosisProgress progress_on(Console& console) {
  return [&console](double share, std::string_view stage) {
    console.progress(share, stage);
    if (!console.is_terminal()) console.detail(fmt::format("{:3.0f} %  {}", 100.0 * share, stage));
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
  }
  const auto report = reports::write_report(folder);
  if (!report) return tl::unexpected(report.error());
  return report->page;
}

Result<ExitCode> run(const Arguments& arguments, Console& console) {
  const auto rows = rows_of(arguments);
  if (!rows) return tl::unexpected(rows.error());
  const auto recordings = data::load_dataset(arguments.text("dataset"), *rows);
  if (!recordings) return tl::unexpected(recordings.error());
  for (const std::string& note : recordings->notes) console.say(note);
  const auto interest = interest_of(arguments);
  if (!interest) return tl::unexpected(interest.error());
  const std::filesystem::path dataset = arguments.text("dataset");
  auto output = OutputFolder::claim({"diagnose",
                                     arguments.text("out"),
                                     recordings->name,
                                     recordings->sha256,
                                     dataset,
                                     {dataset},
                                     arguments.has("force")});
  if (!output) return tl::unexpected(output.error());
  const auto diagnosis = studies::diagnose(*recordings, progress_on(console),
                                           {.holdout = arguments.texts("holdout"),
                                            .nested = !arguments.has("quick"),
                                            .interest = *interest});
  if (!diagnosis) return tl::unexpected(as_reported(diagnosis.error()));
  console.say(fmt::format("{} recording{}, {:.1f} s", recordings->recordings.size(),
                          recordings->recordings.size() == 1 ? "" : "s", diagnosis->seconds));
  const auto page = write_diagnosis(*diagnosis, arguments.text("out"));
  if (!page) return tl::unexpected(page.error());
  std::vector<std::string> files = {"diagnosis.json", "index.html", "summary.html", "report",
                                    "tables"};
  if (diagnosis->model) files.emplace_back("model.toml");
  if (auto done = output->finish(files); !done) return tl::unexpected(done.error());
  console.result(console.json ? diagnosis_artefact(*diagnosis).dump(2)
                              : summary_of(*diagnosis) + "\n" + page->string());
  return kDone;
}

}  // namespace

CommandRow describe_diagnose() {
  return {.id = "diagnose",
          .group = "Fit and diagnose",
          .summary =
              "Where model and recordings differ: locates it, names the missing physics, "
              "models it and proves it on hold-out",
          .arguments = {{.name = "dataset",
                         .meaning = "folder of a data set",
                         .value = "DATASET",
                         .required = true},
                        {.name = "--out",
                         .meaning = "folder for diagnosis.json, model.toml and the report",
                         .value = "DIR",
                         .required = true},
                        {.name = "--holdout",
                         .meaning = "recording that is taken away before the search and on which "
                                    "the result is judged once",
                         .value = "ID",
                         .repeats = true},
                        {.name = "--quick",
                         .meaning = "no search in outer folds: less time, and a proof "
                                    "that is cross-validated, its selection not nested",
                         .value = ""},
                        interest_argument(),
                        rows_argument(),
                        kForce},
          .example = "flexspline diagnose recordings/band-damper --out out/damper",
          .run = run};
}

}  // namespace flexspline::app
