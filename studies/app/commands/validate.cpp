#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "dataset_summary.hpp"
#include "flexspline/core/write_file.hpp"
#include "flexspline/data/commitment.hpp"
#include "flexspline/data/dataset.hpp"
#include "flexspline/data/model_toml.hpp"
#include "flexspline/data/sanity.hpp"
#include "flexspline/studies/conceal.hpp"
#include "flexspline/studies/plan.hpp"
#include "flexspline/studies/trial.hpp"
#include "version.hpp"

namespace flexspline::app {
namespace {

using nlohmann::ordered_json;

/// What was found wrong and worth knowing.
struct Verdict {
  std::string what;
  std::vector<std::string> errors;
  std::vector<std::string> notes;
  int code = static_cast<int>(ErrorCode::bad_data);  ///< where there are errors
  ordered_json understood = {};                      ///< where there are none
  std::string text = {};                             ///< the same for a person
};

std::vector<std::string> messages(const std::vector<data::Finding>& findings) {
  std::vector<std::string> list;
  for (const data::Finding& finding : findings) list.push_back(finding.message());
  return list;
}

Verdict check_dataset(const std::filesystem::path& folder) {
  const data::DatasetReading reading = data::read_dataset(folder);
  Verdict verdict{"data set", messages(reading.errors), messages(reading.notes)};
  if (!reading.set) return verdict;
  verdict.understood = dataset_summary(*reading.set);
  verdict.text = summary_text(verdict.understood);
  for (const data::SanityFinding& one : data::sanity_of(*reading.set)) {
    auto& list = one.severity == data::Severity::error ? verdict.errors : verdict.notes;
    list.push_back(one.message());
  }
  return verdict;
}

void understand(const studies::StudyConfig& study, const studies::StudyPlan& plan,
                Verdict& verdict) {
  std::vector<std::string> inputs;
  for (const auto& input : study.inputs) inputs.push_back(input.id);
  std::vector<std::string> estimators;
  for (const auto& estimator : study.estimators) estimators.push_back(estimator.id);
  verdict.understood = {
      {"name", study.name},  {"seed", study.seed},       {"replicates", study.replicates},
      {"inputs", inputs},    {"estimators", estimators}, {"kind", study.kind},
      {"cases", plan.size()}};
  verdict.text = fmt::format("{}: {} cases\n  inputs      {}\n  estimators  {}", study.name,
                             plan.size(), fmt::join(inputs, ", "), fmt::join(estimators, ", "));
}

Result<Verdict> check_study(const std::filesystem::path& file, const std::string& data_root) {
  const auto reading = studies::read_study(file, data_root);
  if (!reading) return tl::unexpected(reading.error());
  Verdict verdict{"study", messages(reading->errors), {}};
  if (!reading->study) return verdict;
  const auto plan = studies::plan_study(*reading->study, build_id());
  if (plan) {
    understand(*reading->study, *plan, verdict);
    for (const auto& [input, note] : plan->notes) verdict.notes.push_back(input + ": " + note);
  } else {
    verdict.errors.push_back(plan.error().message());
    verdict.code = static_cast<int>(plan.error().code);
  }
  return verdict;
}

std::string hidden_words(const studies::ConcealPlan& plan) {
  if (plan.draw) return "drawn";
  std::string words;
  for (const data::HiddenEffect& one : plan.effects) {
    words += fmt::format("{}{} of {:.3g} % of peak torque", words.empty() ? "" : ", ", one.id,
                         100.0 * one.size_fraction);
  }
  return words.empty() ? "nothing" : words;
}

Result<Verdict> check_bench(const std::filesystem::path& file) {
  const auto reading = studies::read_conceal_plan(file);
  if (!reading) return tl::unexpected(reading.error());
  Verdict verdict{"bench", messages(reading->errors), {}};
  if (!reading->plan) return verdict;
  const studies::ConcealPlan& plan = *reading->plan;
  const std::string hidden = hidden_words(plan);
  const std::string recordings =
      plan.design.empty() ? std::string("drawn") : std::to_string(plan.design.size());
  verdict.understood = {{"rig", name_of(plan.rig)},
                        {"seed", plan.seed},
                        {"hides", hidden},
                        {"recordings", recordings}};
  verdict.text = fmt::format("{} rig, seed {}\n  hides       {}\n  recordings  {}",
                             name_of(plan.rig), plan.seed, hidden, recordings);
  return verdict;
}

Result<Verdict> check_trial(const std::filesystem::path& file) {
  const auto reading = studies::read_trial(file);
  if (!reading) return tl::unexpected(reading.error());
  Verdict verdict{"trial", messages(reading->errors), {}};
  if (!reading->trial) return verdict;
  const studies::TrialConfig& trial = *reading->trial;
  std::vector<std::string_view> rigs;
  for (const data::BenchKind rig : trial.rigs) rigs.push_back(name_of(rig));
  verdict.understood = {
      {"name", trial.name}, {"seed", trial.seed}, {"cases", trial.cases}, {"rigs", rigs}};
  verdict.text = fmt::format("{}: {} cases, seed {}\n  rigs        {}", trial.name, trial.cases,
                             trial.seed, fmt::join(rigs, ", "));
  return verdict;
}

std::string law_words(const LawSpec& law) {
  std::string words = fmt::format("{}, {} coefficients", law.law, law.coefficients.size());
  if (law.valid_to > 0.0) words += fmt::format(", valid to {:.4g} in SI", law.valid_to);
  return words;
}

Verdict check_model(const std::string& content, const std::string& path) {
  const auto model = data::parse_model(content, path);
  if (!model) return {"model", {model.error().message()}, {}};
  std::vector<std::string> effects;
  for (const EffectSpec& one : model->effects) effects.push_back(one.effect);
  Verdict verdict{"model", {}, {}};
  verdict.understood = {{"f", law_words(model->f)},
                        {"g_inverse", law_words(model->g_inverse)},
                        {"h", law_words(model->h)},
                        {"effects", effects}};
  verdict.text =
      fmt::format("f          {}\n  g_inverse  {}\n  h          {}\n  effects    {}",
                  law_words(model->f), law_words(model->g_inverse), law_words(model->h),
                  effects.empty() ? "none" : fmt::format("{}", fmt::join(effects, ", ")));
  return verdict;
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
    return check_model(*content, path.string());
  }
  if (content->find("flexspline-bench/") != std::string::npos) {
    return check_bench(path);
  }
  if (content->find("flexspline-trial/") != std::string::npos) {
    return check_trial(path);
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
    const ordered_json text = {{"path", path},
                               {"is", verdict->what},
                               {"valid", valid},
                               {"errors", verdict->errors},
                               {"notes", verdict->notes},
                               {"understood", verdict->understood}};
    console.result(text.dump(2, ' ', false, ordered_json::error_handler_t::replace));
  } else {
    for (const std::string& error : verdict->errors) console.result("error: " + error);
    for (const std::string& note : verdict->notes) console.result("note: " + note);
    if (!verdict->text.empty()) console.result("  " + verdict->text);
    console.result(
        fmt::format("{}: {} {}", path, valid ? "a valid" : "not a valid", verdict->what));
  }
  return valid ? kDone : verdict->code;
}

}  // namespace

CommandRow describe_validate() {
  return {.id = "validate",
          .group = "Start",
          .summary =
              "Checks a study, trial, bench, model or data set: everything that is wrong at once, "
              "and what was understood",
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
