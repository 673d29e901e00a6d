#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "flexspline/estimators/certified.hpp"
#include "flexspline/estimators/certified_ode.hpp"

namespace flexspline::app {
namespace {

using estimators::Backend;
using estimators::OdeFitMethod;
using nlohmann::ordered_json;

struct Choice {
  std::vector<Backend> backends;
  std::string collection;
  std::string format;

  bool has(std::string_view name) const { return collection == "all" || collection == name; }
};

/// A fit of any suite as the table shows it.
struct Line {
  std::string problem;
  std::string collection;
  std::size_t start = 1;
  std::string solver;
  std::vector<double> parameters{};
  std::vector<double> parameter_digits{};
  double worst_digits = kNotComputed;
  double cost_digits = kNotComputed;
  double judged_digits = kNotComputed;
  double required_digits = kNotComputed;
  double sum_of_squares = kNotComputed;
  int iterations = 0;
  double seconds = kNotComputed;
  Termination termination = Termination::not_run;
  bool other_minimum = false;
  std::string failure{};
  bool passed = false;
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
  const auto collection = word("collection", {"all", "nist", "mgh", "ode"});
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

Line line_of(const estimators::CertifiedRun& run) {
  return {run.problem->id,    run.problem->collection,
          run.start + 1,      std::string(name_of(run.backend)),
          run.parameters,     run.parameter_digits,
          run.worst_digits,   run.cost_digits,
          run.judged_digits,  run.required_digits,
          run.sum_of_squares, run.iterations,
          run.seconds,        run.termination,
          run.other_minimum,  run.failure,
          run.passed()};
}

Line line_of(const estimators::CertifiedOdeRun& run) {
  return {run.problem->name,
          "ode",
          1,
          std::string(name_of(run.method)),
          run.parameters,
          run.parameter_digits,
          run.worst_digits,
          run.cost_digits,
          run.cost_digits,
          estimators::kRequiredOdeDigits,
          run.sum_of_squares,
          run.iterations,
          run.seconds,
          run.termination,
          false,
          run.failure,
          run.passed()};
}

void run_least_squares(const Choice& choice, Console& console, std::vector<Line>& lines) {
  const auto& problems = estimators::certified_problems();
  std::size_t at = 0;
  for (const auto* problem : problems) {
    ++at;
    if (!choice.has(problem->collection)) continue;
    for (std::size_t start = 0; start < problem->starts.size(); ++start) {
      for (Backend backend : choice.backends) {
        console.progress(
            0.9 * static_cast<double>(at) / static_cast<double>(problems.size()),
            fmt::format("{} from start {} by {}", problem->id, start + 1, name_of(backend)));
        lines.push_back(line_of(estimators::run_certified(*problem, start, backend)));
      }
    }
  }
}

// Shooting is done in Ceres, collocation in Ipopt.
void run_odes(const Choice& choice, Console& console, std::vector<Line>& lines) {
  for (const auto& problem : estimators::certified_odes()) {
    for (OdeFitMethod method : {OdeFitMethod::single_shooting, OdeFitMethod::multiple_shooting,
                                OdeFitMethod::collocation}) {
      const Backend backend = method == OdeFitMethod::collocation ? Backend::ipopt : Backend::ceres;
      if (std::ranges::find(choice.backends, backend) == choice.backends.end()) continue;
      console.progress(0.9, fmt::format("{} by {}", problem.name, name_of(method)));
      lines.push_back(line_of(estimators::run_certified(problem, method)));
    }
  }
}

std::vector<Line> run_all(const Choice& choice, Console& console) {
  std::vector<Line> lines;
  run_least_squares(choice, console, lines);
  if (choice.has("ode")) run_odes(choice, console, lines);
  return lines;
}

std::string digits(double value) { return value == value ? fmt::format("{:.1f}", value) : "-"; }

std::string verdict(const Line& run) {
  if (!run.passed) return "FAILED";
  return run.other_minimum ? "local minimum" : "passed";
}

std::string as_table(const std::vector<Line>& runs, bool markdown) {
  const std::string head = markdown ? "| {} | {} | {} | {} | {} | {} | {} | {} | {} |\n"
                                    : "{:<28} {:>5}  {:<17} {:>10} {:>6} {:>8} {:>10} {:>8}  {}\n";
  std::string text = fmt::format(fmt::runtime(head), "problem", "start", "solver", "parameters",
                                 "cost", "required", "iterations", "seconds", "result");
  if (markdown) text += "|---|--:|---|--:|--:|--:|--:|--:|---|\n";
  for (const Line& run : runs) {
    text +=
        fmt::format(fmt::runtime(head), run.problem, run.start, run.solver,
                    digits(run.worst_digits), digits(run.cost_digits), digits(run.required_digits),
                    run.iterations, fmt::format("{:.4f}", run.seconds), verdict(run));
  }
  return text;
}

/// "nist by ceres: 54 of 54 starts passed, least correct digits 6.5 (ENSO from start 2)".
std::string summary_of(const std::vector<Line>& runs, const std::string& collection,
                       const std::string& solver) {
  std::vector<const Line*> chosen;
  for (const Line& run : runs) {
    if (run.collection == collection && run.solver == solver) chosen.push_back(&run);
  }
  const auto passed = std::ranges::count_if(chosen, &Line::passed);
  const auto judged = [](const Line* run) {
    return run->judged_digits == run->judged_digits ? run->judged_digits : -1.0;
  };
  const Line* worst = *std::ranges::min_element(chosen, {}, judged);
  return fmt::format(
      "\n{} by {}: {} of {} starts passed, least correct digits {} ({} from start {})", collection,
      solver, passed, chosen.size(), digits(worst->judged_digits), worst->problem, worst->start);
}

std::string as_text(const std::vector<Line>& runs, bool markdown) {
  std::string text = as_table(runs, markdown);
  std::set<std::pair<std::string, std::string>> told;
  for (const Line& run : runs) {
    if (!told.emplace(run.collection, run.solver).second) continue;
    text += summary_of(runs, run.collection, run.solver) + (markdown ? "\n" : "");
  }
  for (const Line& run : runs) {
    if (!run.failure.empty()) text += fmt::format("\n{}: {}", run.problem, run.failure);
  }
  return text;
}

std::string as_json(const std::vector<Line>& runs) {
  ordered_json rows = ordered_json::array();
  for (const Line& run : runs) {
    rows.push_back({{"problem", run.problem},
                    {"collection", run.collection},
                    {"start", run.start},
                    {"backend", run.solver},
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
                    {"passed", run.passed}});
  }
  return rows.dump(2);
}

Result<ExitCode> run(const Arguments& arguments, Console& console) {
  const auto choice = choice_of(arguments);
  if (!choice) return tl::unexpected(choice.error());
  const auto runs = run_all(*choice, console);
  console.result(console.json ? as_json(runs) : as_text(runs, choice->format == "markdown"));
  return std::ranges::all_of(runs, &Line::passed) ? kDone : kSomethingFailed;
}

}  // namespace

CommandRow describe_selftest() {
  return {
      .id = "selftest",
      .group = "Simulated test cases",
      .summary = "Fits problems of certified solution with every solver and counts the digits",
      .arguments = {{.name = "--backend", .meaning = "solver", .value = "all|ceres|ipopt"},
                    {.name = "--collection",
                     .meaning = "NIST's StRD, More, Garbow and Hillstrom's problems, or those of "
                                "differential equations (COPS)",
                     .value = "all|nist|mgh|ode"},
                    {.name = "--format", .meaning = "of the table", .value = "text|markdown"}},
      .example = "flexspline selftest --backend ceres",
      .run = run};
}

}  // namespace flexspline::app
