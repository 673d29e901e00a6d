#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "flexspline/studies/plan.hpp"
#include "version.hpp"

namespace flexspline::app {
namespace {

std::string as_json(const studies::StudyPlan& plan) {
  nlohmann::ordered_json cases = nlohmann::ordered_json::array();
  for (const studies::CasePlan& one : plan.cases) {
    cases.push_back({{"key", one.key},
                     {"input", one.input->id},
                     {"estimator", one.estimator->id},
                     {"method", one.estimator->method},
                     {"replicate", one.replicate},
                     {"seed", one.seed},
                     {"train", one.train},
                     {"holdout", one.holdout},
                     {"depends_on", one.depends_on}});
  }
  return nlohmann::ordered_json{{"cases", cases},
                                {"split", plan.notes},
                                {"estimated_seconds_one_worker", plan.estimated_seconds},
                                {"estimated_bytes", plan.estimated_bytes}}
      .dump(2);
}

std::string as_text(const studies::StudyPlan& plan) {
  std::string text =
      fmt::format("{:<52} {:>6}  {:>7}  {}\n", "case", "seed", "holdout", "trained on");
  for (const studies::CasePlan& one : plan.cases) {
    text += fmt::format("{:<52} {:>6}  {:>7}  {}\n", one.key, one.seed, one.holdout.size(),
                        fmt::join(one.train, " "));
  }
  for (const auto& [input, note] : plan.notes) text += fmt::format("{}: {}\n", input, note);
  return text + fmt::format("{} cases, about {:.0f} s on one worker, {:.1f} MB", plan.cases.size(),
                            plan.estimated_seconds, plan.estimated_bytes / 1e6);
}

Result<ExitCode> run(const Arguments& arguments, Console& console) {
  const auto study = studies::load_study(arguments.text("study"), arguments.text("data-root"));
  if (!study) return tl::unexpected(study.error());
  const auto plan = studies::plan_study(*study, build_id());
  if (!plan) return tl::unexpected(plan.error());
  console.result(console.json ? as_json(*plan) : as_text(*plan));
  return kDone;
}

}  // namespace

CommandRow describe_plan() {
  return {.id = "plan",
          .summary = "What run would do: cases, seeds, estimated time and disk; writes nothing",
          .arguments =
              {{.name = "study", .meaning = "study file", .value = "STUDY.toml", .required = true},
               {.name = "--data-root",
                .meaning = "where relative data-set paths start; default: the study file's folder",
                .value = "DIR"}},
          .example = "flexspline plan studies/paper.toml",
          .run = run};
}

}  // namespace flexspline::app
