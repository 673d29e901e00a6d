#include "flexspline/studies/plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "flexspline/studies/pilot.hpp"
#include "version.hpp"

namespace flexspline::app {
namespace {

using nlohmann::ordered_json;

constexpr double kPilotSeconds = 2.0;
constexpr std::size_t kMostListed = 10'000;  // cases, where nobody asks for more

ordered_json case_json(const studies::CasePlan& one) {
  return {{"key", one.key},
          {"input", one.input->id},
          {"estimator", one.estimator->id},
          {"method", one.estimator->method},
          {"replicate", one.replicate},
          {"seed", one.seed},
          {"train", one.train},
          {"holdout", one.holdout},
          {"depends_on", one.depends_on}};
}

std::string seeds_text(const studies::StudyConfig& study) {
  const auto last = studies::seed_of(study, study.replicates - 1);
  return study.replicates == 1 ? fmt::format("seed {}", study.seed)
                               : fmt::format("seeds {} to {}", study.seed, last);
}

ordered_json sweeps_json(const studies::StudyConfig& study) {
  ordered_json list = ordered_json::array();
  for (const studies::SweepAxis& sweep : study.sweeps) {
    std::vector<std::string> keys;
    for (const studies::SweepKey& key : sweep.keys) keys.push_back(key.path);
    list.push_back({{"keys", keys}, {"points", sweep.points.size()}});
  }
  return list;
}

std::string as_json(const studies::StudyPlan& plan, const studies::Pilot& pilot, bool list) {
  ordered_json text = {{"study", plan.study->name},
                       {"kind", plan.study->kind},
                       {"count", plan.size()},
                       {"unique_fits", plan.unique_fits()},
                       {"first_seed", plan.study->seed},
                       {"replicates", plan.study->replicates},
                       {"sweeps", sweeps_json(*plan.study)},
                       {"split", plan.notes},
                       {"measured_cases", pilot.measured},
                       {"estimated_seconds_one_worker", pilot.seconds},
                       {"estimated_bytes", pilot.bytes}};
  if (list || plan.size() <= kMostListed) {
    text["cases"] = ordered_json::array();
    for (std::size_t i = 0; i < plan.size(); ++i) text["cases"].push_back(case_json(plan.at(i)));
  }
  return text.dump(2);
}

std::string duration_text(double seconds) {
  if (seconds < 120.0) return fmt::format("{:.2g} s", seconds);
  if (seconds < 7200.0) return fmt::format("{:.0f} min", seconds / 60.0);
  return fmt::format("{:.1f} h", seconds / 3600.0);
}

std::string summary_text(const studies::StudyPlan& plan, const studies::Pilot& pilot) {
  const studies::StudyConfig& study = *plan.study;
  std::string text = fmt::format(
      "{} ({}): {} cases, {} different fits, {}\nabout {} on one worker and {:.3g} MB, from {} "
      "case{} measured now",
      study.name, study.kind, plan.size(), plan.unique_fits(), seeds_text(study),
      duration_text(pilot.seconds), pilot.bytes / 1e6, pilot.measured,
      pilot.measured == 1 ? "" : "s");
  text += fmt::format("\ninputs {}, estimators {}, replicates {}", study.inputs.size(),
                      study.estimators.size(), study.replicates);
  for (const studies::SweepAxis& sweep : study.sweeps) {
    std::vector<std::string> keys;
    for (const studies::SweepKey& key : sweep.keys) keys.push_back(key.path);
    text += fmt::format("\nsweep of {}: {} points", fmt::join(keys, ", "), sweep.points.size());
  }
  for (const auto& [input, note] : plan.notes) text += fmt::format("\n{}: {}", input, note);
  return text;
}

void print_list(const studies::StudyPlan& plan, Console& console) {
  console.result(fmt::format("{:<52} {:>6}  {:>7}  {}", "case", "seed", "holdout", "trained on"));
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const studies::CasePlan one = plan.at(i);
    console.result(fmt::format("{:<52} {:>6}  {:>7}  {}", one.key, one.seed, one.holdout.size(),
                               fmt::join(one.train, " ")));
  }
}

Result<ExitCode> run(const Arguments& arguments, Console& console) {
  const auto study = studies::load_study(arguments.text("study"), arguments.text("data-root"));
  if (!study) return tl::unexpected(study.error());
  const auto plan = studies::plan_study(*study, build_id());
  if (!plan) return tl::unexpected(plan.error());
  const studies::Pilot pilot = studies::measure_pilot(*plan, kPilotSeconds);
  const bool list = arguments.has("list");
  console.result(console.json ? as_json(*plan, pilot, list) : summary_text(*plan, pilot));
  if (list && !console.json) print_list(*plan, console);
  return kDone;
}

}  // namespace

CommandRow describe_plan() {
  return {.id = "plan",
          .summary =
              "What run would do: cases, seeds, time and disk as measured on a few of them; "
              "writes nothing",
          .arguments =
              {{.name = "study", .meaning = "study file", .value = "STUDY.toml", .required = true},
               {.name = "--list", .meaning = "every case, too"},
               {.name = "--data-root",
                .meaning = "where relative data-set paths start; default: the study file's folder",
                .value = "DIR"}},
          .example = "flexspline plan studies/paper.toml",
          .run = run};
}

}  // namespace flexspline::app
