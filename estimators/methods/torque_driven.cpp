#include <algorithm>
#include <chrono>

#include "flexspline/estimators/method.hpp"
#include "solvers/processor_share.hpp"
#include "torque_driven/driven_estimate.hpp"

namespace flexspline::estimators {

MethodRow describe_torque_driven();

namespace {

Result<DrivenFit> fit_by(const std::string& backend, const DrivenProblem& problem,
                         const DrivenSettings& settings, std::size_t threads) {
  std::vector<double> start = driven_start(problem);
  if (backend == "cvodes") return fit_by_cvodes(problem, std::move(start), settings, threads);
  if (backend == "collocation")
    return fit_by_collocation(problem, std::move(start), settings, threads);
  return fit_by_kernels(problem, std::move(start), settings, threads);
}

Result<Estimate> fit(const FitProblem& given) {
  const auto started = std::chrono::steady_clock::now();
  const MethodRow method = describe_torque_driven();
  const auto whole = [&](std::string_view name) {
    return static_cast<int>(number(given, method, name));
  };
  const ProcessorShare share(static_cast<std::size_t>(whole("threads")));
  const std::size_t threads = share.threads();
  const auto problem = driven_problem(
      given.records, whole("f_terms"), whole("g_terms"), whole("h_terms"),
      word(given, method, "initial") == "rest" ? InitialMotion::rest : InitialMotion::measured,
      threads);
  if (!problem) return tl::unexpected(problem.error());
  const DrivenSettings settings{.tolerance = number(given, method, "tolerance"),
                                .max_iterations = whole("iterations")};
  const auto found = fit_by(word(given, method, "backend"), *problem, settings, threads);
  if (!found) return tl::unexpected(found.error());
  auto estimate = driven_estimate(*problem, *found, given.records.front().linear, threads);
  if (!estimate) return estimate;
  estimate->seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return estimate;
}

}  // namespace

MethodRow describe_torque_driven() {
  return {
      .id = "torque_driven",
      .summary =
          "f, g and h of eq. (3) as polynomials over whole recordings from rest, simulated from "
          "the torque: fast, for many recordings at once",
      .source = "Dhaouadi and Ghorbel (2003), eqs. (3), (20), (21), with ln h an even polynomial",
      .options = {{.name = "backend",
                   .meaning = "kernel: explicit or implicit Runge-Kutta for many recordings at "
                              "once; cvodes: CVODES with forward sensitivities; collocation: "
                              "trajectories and coefficients at once by Ipopt",
                   .choices = {"kernel", "cvodes", "collocation"}},
                  {.name = "f_terms",
                   .meaning = "terms of f, an odd polynomial",
                   .value = 3,
                   .lower = 1,
                   .upper = 12},
                  {.name = "g_terms",
                   .meaning = "terms of g, an odd polynomial",
                   .value = 3,
                   .lower = 1,
                   .upper = 12},
                  {.name = "h_terms",
                   .meaning = "terms of ln h, an even polynomial; 0: h = 1",
                   .value = 2,
                   .lower = 0,
                   .upper = 8},
                  {.name = "initial",
                   .meaning = "motion at the first sample: zero, or as measured",
                   .choices = {"rest", "measured"}},
                  {.name = "tolerance",
                   .meaning = "largest error of the integration, over the peak of a recording",
                   .value = 1e-5,
                   .lower = 1e-10,
                   .upper = 1e-2},
                  {.name = "iterations",
                   .meaning = "most iterations of the solver",
                   .value = 100,
                   .lower = 1,
                   .upper = 10000},
                  {.name = "threads",
                   .meaning = "0: as many as processors, shared with other fits that run",
                   .value = 0,
                   .lower = 0,
                   .upper = 256}},
      .fit = fit};
}

}  // namespace flexspline::estimators
