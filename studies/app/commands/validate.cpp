#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "flexspline/core/write_file.hpp"
#include "flexspline/data/commitment.hpp"
#include "flexspline/data/dataset.hpp"
#include "flexspline/data/model_toml.hpp"
#include "flexspline/studies/conceal.hpp"
#include "flexspline/studies/plan.hpp"
#include "flexspline/studies/trial.hpp"
#include "version.hpp"

namespace flexspline::app {
namespace {

/// What was found wrong and worth knowing.
struct Verdict {
  std::string what;
  std::vector<std::string> errors;
  std::vector<std::string> notes;
  int code = static_cast<int>(ErrorCode::bad_data);  ///< where there are errors
};

std::vector<std::string> messages(const std::vector<data::Finding>& findings) {
  std::vector<std::string> list;
  for (const data::Finding& finding : findings) list.push_back(finding.message());
  return list;
}

Verdict check_dataset(const std::filesystem::path& folder) {
  const data::DatasetReading reading = data::read_dataset(folder);
  return {"data set", messages(reading.errors), messages(reading.notes)};
}

Result<Verdict> check_study(const std::filesystem::path& file, const std::string& data_root) {
  const auto reading = studies::read_study(file, data_root);
  if (!reading) return tl::unexpected(reading.error());
  Verdict verdict{"study", messages(reading->errors), {}};
  if (!reading->study) return verdict;
  const auto plan = studies::plan_study(*reading->study, build_id());
  if (plan) {
    for (const auto& [input, note] : plan->notes) verdict.notes.push_back(input + ": " + note);
  } else {
    verdict.errors.push_back(plan.error().message());
    verdict.code = static_cast<int>(plan.error().code);
  }
  return verdict;
}

/// A file of which nothing but the text has to be checked.
template <auto Read>
Result<Verdict> check_plain(std::string what, const std::filesystem::path& file) {
  const auto reading = Read(file);
  if (!reading) return tl::unexpected(reading.error());
  return Verdict{std::move(what), messages(reading->errors), {}};
}

/// An answer against the commitment beside it.
Verdict check_seal(const std::filesystem::path& file) {
  const auto answer = data::unseal(file.parent_path() / "commitment.json", file);
  if (answer) return {"sealed answer, the one that was committed to", {}, {}};
  return {"sealed answer", {answer.error().message()}, {}};
}

Result<Verdict> check(const std::filesystem::path& path, const std::string& data_root) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) return check_dataset(path);
  const auto content = read_file(path);
  if (!content) return tl::unexpected(content.error());
  if (content->find("flexspline-dataset/") != std::string::npos)
    return check_dataset(path.parent_path());
  if (content->find("flexspline-model/") != std::string::npos) {
    const auto model = data::parse_model(*content, path.string());
    return Verdict{
        "model", model ? std::vector<std::string>{} : std::vector{model.error().message()}, {}};
  }
  if (content->find("flexspline-bench/") != std::string::npos) {
    return check_plain<&studies::read_conceal_plan>("bench", path);
  }
  if (content->find("flexspline-trial/") != std::string::npos) {
    return check_plain<[](const auto& file) { return studies::read_trial(file); }>("trial", path);
  }
  if (content->find(data::kSealedSchema) != std::string::npos) return check_seal(path);
  return check_study(path, data_root);
}

Result<ExitCode> run(const Arguments& arguments, Console& console) {
  const std::string path = arguments.text("path");
  const auto verdict = check(path, arguments.text("data-root"));
  if (!verdict) return tl::unexpected(verdict.error());
  const bool valid = verdict->errors.empty();
  if (console.json) {
    const nlohmann::ordered_json text = {{"path", path},
                                         {"is", verdict->what},
                                         {"valid", valid},
                                         {"errors", verdict->errors},
                                         {"notes", verdict->notes}};
    console.result(text.dump(2));
  } else {
    for (const std::string& error : verdict->errors) console.result("error: " + error);
    for (const std::string& note : verdict->notes) console.result("note: " + note);
    console.result(
        fmt::format("{}: {} {}", path, valid ? "a valid" : "not a valid", verdict->what));
  }
  return valid ? kDone : verdict->code;
}

}  // namespace

CommandRow describe_validate() {
  return {.id = "validate",
          .summary =
              "Checks a study, trial, bench, model or data set and says everything that is wrong "
              "at once",
          .arguments = {{.name = "path",
                         .meaning = "study, trial, bench or model file, or folder of a data set",
                         .value = "FILE|DATASET",
                         .required = true},
                        {.name = "--data-root",
                         .meaning = "where a study's relative data-set paths start",
                         .value = "DIR"}},
          .example = "flexspline validate studies/paper.toml",
          .run = run};
}

}  // namespace flexspline::app
