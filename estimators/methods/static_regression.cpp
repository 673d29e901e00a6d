#include <chrono>

#include "flexspline/estimators/method.hpp"
#include "torsion/torsion_estimate.hpp"
#include "torsion/torsion_options.hpp"

namespace flexspline::estimators {

MethodRow describe_static_regression();

namespace {

Result<Estimate> fit(const FitProblem& problem) {
  const auto started = std::chrono::steady_clock::now();
  const MethodRow method = describe_static_regression();
  StaticFitSettings settings = static_settings(problem, method);
  settings.intervals = static_cast<std::size_t>(number(problem, method, "intervals"));
  const auto found = fit_static(problem.records, settings);
  if (!found) return tl::unexpected(found.error());
  auto estimate = torsion_estimate("static_regression", found->fit, *found,
                                   {uncertainty_settings(problem, method),
                                    settings.solver,
                                    {},
                                    word(problem, method, "bands") == "mixed_model"});
  if (!estimate) return tl::unexpected(estimate.error());
  estimate->seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return estimate;
}

}  // namespace

MethodRow describe_static_regression() {
  return {.id = "static_regression",
          .summary =
              "f, g^-1, h and delay of eq. (4) by regression of the torque on the measured "
              "motion and its speed: the laws of trajectory_ceres, no differential equation",
          .source = "Dhaouadi and Ghorbel (2003), eq. (4); Ramsay (1988)",
          .options = with_torsion_options(
              {{.name = "intervals",
                .meaning = "even intervals of the cubic splines of f and of g^-1 on each side of "
                           "zero; 0: knots and sides as the Bayesian criterion prefers",
                .value = 0,
                .lower = 0,
                .upper = 100}}),
          .fit = fit};
}

}  // namespace flexspline::estimators
