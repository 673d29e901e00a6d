#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "flexspline/estimators/certified.hpp"
#include "solvers/least_squares.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// One choice for all problems: to the last digit, as far as it takes.
constexpr SolverSettings kToTheLastDigit{.max_iterations = 20000,
                                         .function_tolerance = 1e-17,
                                         .parameter_tolerance = 1e-17,
                                         .gradient_tolerance = 1e-30,
                                         .damping_floor = 1.0};

std::vector<BoundedParameter> parameters_of(const CertifiedProblem& problem, std::size_t start) {
  std::vector<BoundedParameter> parameters;
  for (std::size_t k = 0; k < problem.starts[start].size(); ++k) {
    const double value = problem.starts[start][k];
    parameters.push_back({.start = value,
                          .lower = problem.lower.empty() ? -kInfinity : problem.lower[k],
                          .upper = problem.upper.empty() ? kInfinity : problem.upper[k],
                          .scale = value == 0.0 ? 1.0 : std::abs(value)});
  }
  return parameters;
}

void judge_cost(CertifiedRun& run) {
  run.cost_digits = correct_digits(run.sum_of_squares, run.problem->sum_of_squares);
  for (double other : run.problem->other_minima) {
    const double digits = correct_digits(run.sum_of_squares, other);
    if (digits <= run.cost_digits) continue;
    run.cost_digits = digits;
    run.other_minimum = true;
  }
}

void judge(CertifiedRun& run) {
  judge_cost(run);
  const auto& certified = run.problem->parameters;
  for (std::size_t k = 0; k < certified.size(); ++k) {
    run.parameter_digits.push_back(correct_digits(run.parameters[k], certified[k]));
  }
  if (!certified.empty()) run.worst_digits = *std::ranges::min_element(run.parameter_digits);
  run.judged_digits = certified.empty() ? run.cost_digits : run.worst_digits;
}

double required_digits(const CertifiedProblem& problem, Backend backend) {
  return !problem.parameters.empty() && backend == Backend::ceres ? 6.0 : 4.0;
}

}  // namespace

std::string_view name_of(Backend backend) { return backend == Backend::ceres ? "ceres" : "ipopt"; }

double correct_digits(double value, double certified) {
  if (std::isnan(value) || std::isnan(certified)) return kNotComputed;
  const double error = std::abs(value - certified) / (certified == 0.0 ? 1.0 : std::abs(certified));
  return error == 0.0 ? kMostDigits : std::clamp(-std::log10(error), 0.0, kMostDigits);
}

std::vector<const CertifiedProblem*> certified_problems() {
  std::vector<const CertifiedProblem*> list;
  for (const auto& family : certified_families()) {
    for (const auto& problem : family.problems) list.push_back(&problem);
  }
  std::ranges::sort(list, [](const CertifiedProblem* a, const CertifiedProblem* b) {
    return std::pair(b->collection, a->id) < std::pair(a->collection, b->id);
  });
  return list;
}

CertifiedRun run_certified(const CertifiedProblem& problem, std::size_t start, Backend backend) {
  CertifiedRun run{.problem = &problem, .start = start, .backend = backend};
  run.required_digits = required_digits(problem, backend);
  const auto parameters = parameters_of(problem, start);
  const auto began = std::chrono::steady_clock::now();
  const auto solve = backend == Backend::ceres ? minimise : minimise_ipopt;
  const auto solution = solve(*problem.residuals, parameters, kToTheLastDigit);
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  if (!solution) {
    run.termination = Termination::failed;
    run.failure = solution.error().message();
    return run;
  }
  run.termination = solution->termination;
  run.iterations = solution->iterations;
  run.parameters = solution->p;
  run.sum_of_squares = 2.0 * solution->cost;
  judge(run);
  return run;
}

}  // namespace flexspline::estimators
