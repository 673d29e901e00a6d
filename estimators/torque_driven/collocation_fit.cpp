#include <algorithm>
#include <cmath>

#include "torque_driven/collocation_mesh.hpp"
#include "torque_driven/driven_fit.hpp"
#include "torque_driven/integration_plan.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kRoughDecrease = 1e-4;  // of shooting, that ends the warm start
constexpr int kMostMeshes = 4;

double cost_of_nothing(const DrivenProblem& problem) {
  double sum = 0.0;
  for (const auto& one : problem.series) {
    for (std::size_t i = 1; i < one.motion.size(); ++i) {
      sum += 0.5 * std::pow(one.weight[i] * one.motion[i], 2);
    }
  }
  return sum;
}

}  // namespace

// Warm start: coefficients after a few steps of shooting, with the trajectory that they give. What
// the mesh cannot follow is foreseen there, and looked for again at the solution.
Result<DrivenFit> fit_by_collocation(const DrivenProblem& problem, std::vector<double> p,
                                     const DrivenSettings& settings, std::size_t threads) {
  IntegrationPlan plan(problem, p, settings.instructions, threads);
  DrivenFit fit{.p = std::move(p), .at = {}};
  NlpSettings nlp_settings{.tolerance = 1e-9, .max_iterations = settings.max_iterations};
  nlp_settings.objective_scale = 1.0 / cost_of_nothing(problem);
  fit.p = gauss_newton(std::move(fit.p), evaluation_by(problem, plan),
                       {.max_iterations = settings.max_iterations, .decrease = kRoughDecrease})
              .p;
  plan.refine(fit.p, settings.tolerance);
  CollocationMesh mesh(problem);
  mesh.divide(mesh.foreseen(fit.p, plan.states(fit.p)), plan.states(fit.p), settings.tolerance);
  for (int round = 0; round < kMostMeshes; ++round) {
    const auto start = mesh.packed(fit.p, plan.states(fit.p));
    plan.unpack();
    const auto found = minimise(DrivenNlp(problem, mesh.meshes()), start, nlp_settings);
    if (!found) return tl::unexpected(found.error());
    fit.iterations += found->iterations;
    fit.evaluations += found->evaluations;
    fit.termination = found->termination;
    fit.p.assign(found->x.begin(), found->x.begin() + static_cast<std::ptrdiff_t>(problem.size()));
    auto equations = evaluation_by(problem, plan)(fit.p);
    if (!equations) {
      return failure(ErrorCode::numerics, "the solution of collocation cannot be integrated",
                     "fit fewer terms");
    }
    fit.at = std::move(*equations);
    const Refinement looked = mesh.divide(found->x, plan.states(fit.p), settings.tolerance);
    fit.integration_error = looked.error;
    if (!looked.changed || fit.termination != Termination::converged) break;
  }
  return fit;
}

}  // namespace flexspline::estimators
