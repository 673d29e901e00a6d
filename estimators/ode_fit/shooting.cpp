#include "ode_fit/methods.hpp"
#include "ode_fit/shooting_problem.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kWeights[] = {10.0, 100.0, 1000.0};
constexpr int kPasses = 12;
constexpr double kClosed = 1e-9;  // jump, in state scales, that counts as none

SolverSettings solver_settings(const OdeFitSettings& settings) {
  return {settings.max_iterations, 1e-13, 1e-13, 1};
}

void take(OdeSolution& solution, const LeastSquaresSolution& found) {
  solution.q = found.p;
  solution.cost = found.cost;
  solution.termination = found.termination;
  solution.iterations += found.iterations;
  solution.evaluations += found.evaluations;
}

}  // namespace

Result<OdeSolution> single_shooting(const OdeLayout& layout, const OdeFitSettings& settings) {
  const ShootingProblem problem(layout, settings.integration_tolerance, 1);
  auto found = minimise(problem, problem.bounded_parameters(), solver_settings(settings));
  if (!found) return tl::unexpected(std::move(found).error());
  OdeSolution solution;
  take(solution, *found);
  solution.elements = problem.blocks();
  return solution;
}

// Joins the segments by the method of multipliers, whose solution has no jumps at finite weight
// (Hestenes, 1969; Powell, 1969). Weights grow first, so that early steps may leave jumps.
Result<OdeSolution> multiple_shooting(const OdeLayout& layout, const OdeFitSettings& settings) {
  ShootingProblem problem(layout, settings.integration_tolerance, settings.segments);
  auto parameters = problem.bounded_parameters();
  OdeSolution solution;
  solution.elements = problem.blocks();
  for (int pass = 0; pass < kPasses; ++pass) {
    problem.set_weight(
        kWeights[std::min<std::size_t>(static_cast<std::size_t>(pass), std::size(kWeights) - 1)]);
    auto found = minimise(problem, parameters, solver_settings(settings));
    if (!found) return tl::unexpected(std::move(found).error());
    take(solution, *found);
    for (std::size_t k = 0; k < parameters.size(); ++k) parameters[k].start = found->p[k];
    const auto jump = problem.update_multipliers(found->p);
    if (!jump) return tl::unexpected(jump.error());
    solution.gap = *jump;
    if (*jump < kClosed) break;
  }
  const auto cost = problem.data_cost(solution.q);
  if (!cost) return tl::unexpected(cost.error());
  solution.cost = *cost;
  if (solution.gap >= kClosed) solution.termination = Termination::no_progress;
  solution.q.resize(layout.unknowns.size());
  return solution;
}

}  // namespace flexspline::estimators
