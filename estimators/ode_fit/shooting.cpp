#include <algorithm>

#include "ode_fit/methods.hpp"
#include "ode_fit/weighted_shooting.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kWeights[] = {10.0, 100.0, 1000.0};
constexpr std::size_t kPasses = 12;
constexpr double kNoJump = 1e-10;     // in state scales
constexpr double kSmallJump = 1e-6;   // the same, if closing it does not change the cost
constexpr double kNoChange = 1e-8;    // of the cost, relative
constexpr double kNoise = 1e-7;       // the same, where the integrator's noise allows no better
constexpr std::size_t kPatience = 5;  // passes before that counts

SolverSettings solver_settings(const OdeFitSettings& settings) {
  return {.max_iterations = settings.max_iterations,
          .function_tolerance = settings.function_tolerance,
          .parameter_tolerance = 1e-13,
          .slopes_at_trials = true};
}

// Early passes need not settle, for their jumps are not the last.
SolverSettings pass_settings(const OdeFitSettings& settings, std::size_t pass) {
  SolverSettings result = solver_settings(settings);
  if (pass + 1 < std::size(kWeights)) result.function_tolerance = 1e-6;
  return result;
}

bool is_closed(const Jumps& jumps, double cost, std::size_t pass) {
  if (pass + 1 < std::size(kWeights)) return false;
  const double change = pass < kPatience ? kNoChange : kNoise;
  return jumps.largest < kNoJump || (jumps.largest < kSmallJump && jumps.worth < change * cost);
}

void take(OdeSolution& solution, const LeastSquaresSolution& found) {
  solution.q = found.p;
  solution.cost = found.cost;
  solution.termination = found.termination;
  solution.iterations += found.iterations;
  solution.evaluations += found.evaluations;
}

tl::unexpected<Error> no_inequalities() {
  return failure(ErrorCode::usage, "shooting knows bounds of parameters, but no other inequalities",
                 "fit by collocation, or write the law so that it cannot break them");
}

}  // namespace

Result<OdeSolution> single_shooting(const OdeLayout& layout, const OdeFitSettings& settings) {
  if (layout.inequalities != nullptr) return no_inequalities();
  const ShootingProblem shots(layout, settings.integration_tolerance, 1);
  const WeightedShooting problem(layout, shots);
  auto found = minimise(problem, shots.bounded_parameters(), solver_settings(settings));
  if (!found) return tl::unexpected(std::move(found).error());
  OdeSolution solution;
  take(solution, *found);
  solution.elements = shots.blocks();
  return solution;
}

// Joins the segments by the method of multipliers, whose solution has no jumps at finite weight
// (Hestenes, 1969; Powell, 1969). Weights grow first, so that early steps may leave jumps.
Result<OdeSolution> multiple_shooting(const OdeLayout& layout, const OdeFitSettings& settings) {
  if (layout.inequalities != nullptr) return no_inequalities();
  ShootingProblem shots(layout, settings.integration_tolerance, settings.segments);
  const WeightedShooting problem(layout, shots);
  auto parameters = shots.bounded_parameters();
  OdeSolution solution;
  solution.elements = shots.blocks();
  bool closed = false;
  for (std::size_t pass = 0; pass < kPasses && !closed; ++pass) {
    shots.set_weight(kWeights[std::min(pass, std::size(kWeights) - 1)]);
    const auto found = minimise(problem, parameters, pass_settings(settings, pass));
    if (!found) return tl::unexpected(found.error());
    take(solution, *found);
    for (std::size_t k = 0; k < parameters.size(); ++k) parameters[k].start = found->p[k];
    const auto jumps = shots.update_multipliers(found->p);
    const auto cost = problem.data_cost(found->p);
    if (!jumps || !cost) return tl::unexpected(jumps ? cost.error() : jumps.error());
    solution.gap = jumps->largest;
    solution.cost = *cost;
    closed = is_closed(*jumps, *cost, pass);
  }
  if (!closed) solution.termination = Termination::no_progress;
  solution.q.resize(layout.unknowns.size());
  return solution;
}

}  // namespace flexspline::estimators
