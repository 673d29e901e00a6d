// The table of docs/certified.md, computed again; seconds are the machine's.
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "claims/claims.hpp"
#include "flexspline/estimators/certified.hpp"
#include "flexspline/estimators/certified_ode.hpp"

namespace flexspline::estimators {
namespace {

using claims::Number;

/// The numbers of a row; where there is no certified value the page has a dash.
template <class Run>
void add_row(std::vector<Number>& numbers, const std::string& name, double start, const Run& run,
             double required) {
  for (const auto& token : claims::numbers_in(name)) {
    numbers.push_back({name, std::stod(token.text)});
  }
  numbers.push_back({name + ", start", start});
  if (!std::isnan(run.worst_digits)) numbers.push_back({name + ", parameters", run.worst_digits});
  if (!std::isnan(run.cost_digits)) numbers.push_back({name + ", cost", run.cost_digits});
  numbers.push_back({name + ", required", required});
  numbers.push_back({name + ", iterations", static_cast<double>(run.iterations)});
  numbers.push_back({name + ", seconds", kNotComputed});
}

/// "nist by ceres: 54 of 54 starts passed, least correct digits 6.8 (ENSO from start 1)".
struct Summary {
  double passed = 0.0;
  double starts = 0.0;
  double least = kMostDigits;
  std::string problem{};
  double start = 0.0;

  void add(const std::string& name, double from, double digits, bool good) {
    passed += good ? 1.0 : 0.0;
    starts += 1.0;
    if (!problem.empty() && !(digits < least)) return;
    least = digits;
    problem = name;
    start = from;
  }
  void add_to(std::vector<Number>& numbers, const std::string& words) const {
    numbers.push_back({words + ", passed", passed});
    numbers.push_back({words + ", starts", starts});
    numbers.push_back({words + ", least digits", least});
    for (const auto& token : claims::numbers_in(problem)) {
      numbers.push_back({problem, std::stod(token.text)});
    }
    numbers.push_back({words + ", least from start", start});
  }
};

TEST(CertifiedPage, HasTheDigitsThatTheSolversReach) {
  std::vector<Number> numbers;
  std::map<std::string, Summary> summaries;
  for (const CertifiedProblem* problem : certified_problems()) {
    for (std::size_t start = 0; start < problem->starts.size(); ++start) {
      for (const Backend backend : {Backend::ceres, Backend::ipopt}) {
        const auto run = run_certified(*problem, start, backend);
        const auto from = static_cast<double>(start + 1);
        add_row(numbers, problem->id, from, run, run.required_digits);
        summaries[fmt::format("{} by {}", problem->collection, name_of(backend))].add(
            problem->id, from, run.judged_digits, run.passed());
      }
    }
  }
  for (const CertifiedOde& problem : certified_odes()) {
    for (const OdeFitMethod method : {OdeFitMethod::single_shooting,
                                      OdeFitMethod::multiple_shooting, OdeFitMethod::collocation}) {
      const auto run = run_certified(problem, method);
      add_row(numbers, problem.name, 1.0, run, kRequiredOdeDigits);
      summaries[fmt::format("ode by {}", name_of(method))].add(problem.name, 1.0, run.cost_digits,
                                                               run.passed());
    }
  }
  for (const char* line :
       {"nist by ceres", "nist by ipopt", "mgh by ceres", "mgh by ipopt", "ode by single_shooting",
        "ode by multiple_shooting", "ode by collocation"}) {
    summaries.at(line).add_to(numbers, line);
  }
  claims::expect("docs/certified.md", "certified", numbers);
}

}  // namespace
}  // namespace flexspline::estimators
