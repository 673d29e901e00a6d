// The table of docs/certified.md, computed again; seconds are the machine's.
#include <cmath>

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

TEST(CertifiedPage, HasTheDigitsThatTheSolversReach) {
  std::vector<Number> numbers;
  for (const CertifiedProblem* problem : certified_problems()) {
    for (std::size_t start = 0; start < problem->starts.size(); ++start) {
      for (const Backend backend : {Backend::ceres, Backend::ipopt}) {
        const auto run = run_certified(*problem, start, backend);
        add_row(numbers, problem->id, static_cast<double>(start + 1), run, run.required_digits);
      }
    }
  }
  for (const CertifiedOde& problem : certified_odes()) {
    for (const OdeFitMethod method : {OdeFitMethod::single_shooting,
                                      OdeFitMethod::multiple_shooting, OdeFitMethod::collocation}) {
      add_row(numbers, problem.name, 1.0, run_certified(problem, method), kRequiredOdeDigits);
    }
  }
  claims::expect("docs/certified.md", "certified", numbers);
}

}  // namespace
}  // namespace flexspline::estimators
