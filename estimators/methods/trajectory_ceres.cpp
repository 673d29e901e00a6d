#include <chrono>

#include "flexspline/estimators/method.hpp"
#include "torsion/torsion_estimate.hpp"
#include "torsion/torsion_options.hpp"

namespace flexspline::estimators {

MethodRow describe_trajectory_ceres();

namespace {

// Where the motion is imposed and free to travel eq. (3) has no spring that brings it back; and a
// model that misses the torque by more than the noise drifts away from the torsion.
Direction direction_of(const FitProblem& problem, const MethodRow& method, bool misses) {
  const std::string asked = word(problem, method, "simulate");
  if (asked != "auto") return asked == "torque" ? Direction::torque : Direction::torsion;
  const auto& record = problem.records.front();
  return record.travels || record.linear || misses ? Direction::torque : Direction::torsion;
}

Result<Estimate> fit(const FitProblem& problem) {
  const auto started = std::chrono::steady_clock::now();
  const MethodRow method = describe_trajectory_ceres();
  const StaticFitSettings settings = static_settings(problem, method);
  const auto begun = fit_static(problem.records, settings);
  if (!begun) return tl::unexpected(begun.error());
  const double tolerance = number(problem, method, "tolerance");
  const IntegratorSettings integrator{tolerance, tolerance, 200000};
  Result<TrajectoryFit> result = begun->fit;
  if (direction_of(problem, method, begun->misses) == Direction::torsion) {
    result = fit_torsion(begun->fit, begun->records, settings.solver, integrator);
  }
  if (!result) return tl::unexpected(result.error());
  auto estimate = torsion_estimate("trajectory_ceres", std::move(*result), *begun,
                                   {uncertainty_settings(problem, method), settings.solver,
                                    integrator, word(problem, method, "bands") == "mixed_model"});
  if (!estimate) return tl::unexpected(estimate.error());
  estimate->seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return estimate;
}

}  // namespace

MethodRow describe_trajectory_ceres() {
  return {.id = "trajectory_ceres",
          .summary =
              "f, g^-1 and h of eq. (3) over whole recordings: CVODES with forward "
              "sensitivities inside Ceres",
          .source = "Dhaouadi and Ghorbel (2003), eqs. (3), (4); laws of the catalogue",
          .options = with_torsion_options(
              {{.name = "simulate",
                .meaning = "what is simulated and compared: torsion by eq. (3) from the "
                           "torque, or torque by eq. (4) from the motion; auto: torsion, "
                           "but torque where an angle or a displacement is imposed or "
                           "where the model misses more than the noise",
                .choices = {"auto", "torsion", "torque"}},
               {.name = "tolerance",
                .meaning = "relative and absolute tolerance of the integration",
                .value = 1e-7,
                .lower = 1e-12,
                .upper = 1e-3}}),
          .fit = fit};
}

}  // namespace flexspline::estimators
