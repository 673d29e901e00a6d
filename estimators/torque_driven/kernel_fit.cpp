#include "torque_driven/driven_fit.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "torque_driven/integration_plan.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kSmallDamping = 1e-6;
constexpr int kMostRefinements = 5;

}  // namespace

// On the way the steps need only be stable. At the optimum they are looked at, and where they are
// refined the optimum is found again from there.
DrivenFit fit_by_kernels(const DrivenProblem& problem, std::vector<double> p,
                         const DrivenSettings& settings, std::size_t threads) {
  IntegrationPlan plan(problem, p, settings.instructions, threads);
  DrivenFit fit{.p = std::move(p), .at = {}};
  const NormalEvaluation evaluate = evaluation_by(problem, plan);
  GaussNewtonSettings newton{.max_iterations = settings.max_iterations};
  for (int round = 0; round < kMostRefinements; ++round) {
    auto found = gauss_newton(fit.p, evaluate, newton);
    fit.iterations += found.iterations;
    fit.evaluations += found.evaluations;
    fit.termination = found.termination;
    fit.p = std::move(found.p);
    fit.at = std::move(found.at);
    if (fit.termination != Termination::converged) break;
    const Refinement looked = plan.refine(fit.p, settings.tolerance);
    fit.integration_error = looked.error;
    if (!looked.changed) break;
    newton.first_damping = kSmallDamping;
  }
  if (plan.stiff() > 0) {
    fit.notes.push_back(fmt::format("{} of {} recordings are stiff and integrated by Radau IIA",
                                    plan.stiff(), problem.series.size()));
  }
  if (fit.integration_error > settings.tolerance) {
    fit.notes.push_back(fmt::format("the integration error is {:.1g} of the peak of a recording",
                                    fit.integration_error));
  }
  return fit;
}

}  // namespace flexspline::estimators
