#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "flexspline/estimators/certified.hpp"

namespace flexspline::app {
namespace {

using estimators::Backend;
using estimators::CertifiedRun;
using nlohmann::ordered_json;

struct Choice {
  std::vector<Backend> backends;
  std::string collection;
  std::string format;
};

Result<Choice> choice_of(const Arguments& arguments) {
  const auto word = [&](const std::string& name,
                        std::initializer_list<std::string_view> words) -> Result<std::string> {
    const std::string given = arguments.text(name, std::string(*words.begin()));
    if (std::ranges::find(words, given) != words.end()) return given;
    std::string list;
    for (std::string_view one : words) list += (list.empty() ? "" : ", ") + std::string(one);
    return failure(ErrorCode::usage, fmt::format("--{} '{}' is not known", name, given),
                   "give one of " + list);
  };
  const auto backend = word("backend", {"all", "ceres", "ipopt"});
  const auto collection = word("collection", {"all", "nist", "mgh"});
  const auto format = word("format", {"text", "markdown"});
  for (const auto* one : {&backend, &collection, &format}) {
    if (!*one) return tl::unexpected(one->error());
  }
  Choice choice{{}, *collection, *format};
  for (Backend one : {Backend::ceres, Backend::ipopt}) {
    if (*backend == "all" || *backend == name_of(one)) choice.backends.push_back(one);
  }
  return choice;
}

std::vector<CertifiedRun> run_all(const Choice& choice, Console& console) {
  std::vector<CertifiedRun> runs;
  for (const auto* problem : estimators::certified_problems()) {
    if (choice.collection != "all" && choice.collection != problem->collection) continue;
    for (std::size_t start = 0; start < problem->starts.size(); ++start) {
      for (Backend backend : choice.backends) {
        console.live(
            fmt::format("{} from start {} by {}", problem->id, start + 1, name_of(backend)));
        runs.push_back(estimators::run_certified(*problem, start, backend));
      }
    }
  }
  return runs;
}

std::string digits(double value) { return value == value ? fmt::format("{:.1f}", value) : "-"; }

std::string verdict(const CertifiedRun& run) {
  if (!run.passed()) return "FAILED";
  return run.other_minimum ? "local minimum" : "passed";
}

std::string as_table(const std::vector<CertifiedRun>& runs, bool markdown) {
  const std::string head = markdown ? "| {} | {} | {} | {} | {} | {} | {} | {} | {} |\n"
                                    : "{:<28} {:>5}  {:<7} {:>10} {:>6} {:>8} {:>10} {:>8}  {}\n";
  std::string text = fmt::format(fmt::runtime(head), "problem", "start", "backend", "parameters",
                                 "cost", "required", "iterations", "seconds", "result");
  if (markdown) text += "|---|--:|---|--:|--:|--:|--:|--:|---|\n";
  for (const CertifiedRun& run : runs) {
    text +=
        fmt::format(fmt::runtime(head), run.problem->id, run.start + 1, name_of(run.backend),
                    digits(run.worst_digits), digits(run.cost_digits), digits(run.required_digits),
                    run.iterations, fmt::format("{:.4f}", run.seconds), verdict(run));
  }
  return text;
}

/// "nist by ceres: 54 of 54 starts passed, least correct digits 6.5 (ENSO from start 2)".
std::string summary_of(const std::vector<CertifiedRun>& runs, std::string_view collection,
                       Backend backend) {
  std::vector<const CertifiedRun*> chosen;
  for (const CertifiedRun& run : runs) {
    if (run.problem->collection == collection && run.backend == backend) chosen.push_back(&run);
  }
  if (chosen.empty()) return {};
  const auto passed = std::ranges::count_if(chosen, &CertifiedRun::passed);
  const auto judged = [](const CertifiedRun* run) {
    return run->judged_digits == run->judged_digits ? run->judged_digits : -1.0;
  };
  const CertifiedRun* worst = *std::ranges::min_element(chosen, {}, judged);
  return fmt::format(
      "\n{} by {}: {} of {} starts passed, least correct digits {} ({} from start {})", collection,
      name_of(backend), passed, chosen.size(), digits(worst->judged_digits), worst->problem->id,
      worst->start + 1);
}

std::string as_text(const std::vector<CertifiedRun>& runs, bool markdown) {
  std::string text = as_table(runs, markdown);
  for (const char* collection : {"nist", "mgh"}) {
    for (Backend backend : {Backend::ceres, Backend::ipopt}) {
      const std::string line = summary_of(runs, collection, backend);
      text += line.empty() || !markdown ? line : line + "\n";
    }
  }
  for (const CertifiedRun& run : runs) {
    if (!run.failure.empty()) text += fmt::format("\n{}: {}", run.problem->id, run.failure);
  }
  return text;
}

std::string as_json(const std::vector<CertifiedRun>& runs) {
  ordered_json rows = ordered_json::array();
  for (const CertifiedRun& run : runs) {
    rows.push_back({{"problem", run.problem->id},
                    {"collection", run.problem->collection},
                    {"start", run.start + 1},
                    {"backend", name_of(run.backend)},
                    {"parameters", run.parameters},
                    {"parameter_digits", run.parameter_digits},
                    {"worst_digits", run.worst_digits},
                    {"sum_of_squares", run.sum_of_squares},
                    {"cost_digits", run.cost_digits},
                    {"required_digits", run.required_digits},
                    {"iterations", run.iterations},
                    {"seconds", run.seconds},
                    {"termination", name_of(run.termination)},
                    {"other_minimum", run.other_minimum},
                    {"failure", run.failure},
                    {"passed", run.passed()}});
  }
  return rows.dump(2);
}

Result<ExitCode> run(const Arguments& arguments, Console& console) {
  const auto choice = choice_of(arguments);
  if (!choice) return tl::unexpected(choice.error());
  const auto runs = run_all(*choice, console);
  console.result(console.json ? as_json(runs) : as_text(runs, choice->format == "markdown"));
  return std::ranges::all_of(runs, &CertifiedRun::passed) ? kDone : kSomethingFailed;
}

}  // namespace

CommandRow describe_selftest() {
  return {.id = "selftest",
          .summary = "Fits problems of certified solution with every solver and counts the digits",
          .arguments = {{.name = "--backend", .meaning = "solver", .value = "all|ceres|ipopt"},
                        {.name = "--collection",
                         .meaning = "NIST's StRD, or More, Garbow and Hillstrom's problems",
                         .value = "all|nist|mgh"},
                        {.name = "--format", .meaning = "of the table", .value = "text|markdown"}},
          .example = "flexspline selftest --backend ceres",
          .run = run};
}

}  // namespace flexspline::app
