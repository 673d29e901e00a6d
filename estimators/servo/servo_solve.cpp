#include "servo/servo_solve.hpp"

#include <cmath>

#include <fmt/format.h>

#include "flexspline/estimators/multistart.hpp"
#include "flexspline/estimators/ode_search.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kMagnitude = 0.1;    // misfits beyond which an error costs its magnitude
constexpr long kMostSteps = 20000;    // of one recording's simulation; some thousand are usual
constexpr double kSpread = 2.0;       // factor within which other starts are drawn
constexpr double kDriveSpread = 1.3;  // the same of the drive's constants, which have an estimate
constexpr double kSameCost = 1e-3;    // relative: the tolerance of a fit's end, with room
constexpr double kFiner = 0.1;        // tolerance at which a fit is simulated again
constexpr double kSteady = 0.05;      // relative difference of its costs that is none
constexpr double kNothing = 1e-3;     // a difference of costs that is none, in squared misfits
constexpr double kCoarser = 10.0;     // tolerance of a search: costs are compared, no more

OdeFitSettings how_to_fit(const ServoSettings& settings) {
  OdeFitSettings how{.integration_tolerance = settings.tolerance,
                     .most_steps = kMostSteps,
                     .max_iterations = settings.most_iterations};
  how.function_tolerance = 1e-5;
  if (settings.loss == ServoLoss::absolute) {
    how.loss = Loss::soft_l1;
    how.loss_scale = kMagnitude;
  }
  how.propose_recording = false;
  return how;
}

Result<OdeFit> from_many(const OdeFitProblem& problem, const ServoSettings& settings) {
  auto many = fit_ode_from_many(problem, OdeFitMethod::single_shooting, how_to_fit(settings),
                                {.starts = settings.starts,
                                 .seed = settings.seed,
                                 .spread = kSpread,
                                 .same_cost = kSameCost});
  if (!many) return tl::unexpected(many.error());
  return std::move(many->best);
}

/// Derivatives end at the next cliff: what says that there is no lower cost is that searches agree.
Result<OdeFit> from_search(const std::vector<OdeFitProblem>& copies,
                           const ServoSettings& settings) {
  auto how = how_to_fit(settings);
  how.integration_tolerance *= kCoarser;
  const auto found = search_ode(copies, how,
                                {.searches = settings.searches,
                                 .seed = settings.seed,
                                 .spread = kSpread,
                                 .spreads = {{"torque_constant", kDriveSpread},
                                             {"resistance", kDriveSpread},
                                             {"motor_inertia", kDriveSpread}}});
  if (!found) return tl::unexpected(found.error());
  OdeFitProblem problem = copies.front();
  for (std::size_t k = 0; k < found->best.size(); ++k) problem.parameters[k].start = found->best[k];
  auto fit = fit_ode(problem, OdeFitMethod::single_shooting, how_to_fit(settings));
  if (!fit) return fit;
  fit->evaluations += found->evaluations;
  fit->notes.push_back(found->says);
  if (found->at_best < 2 && fit->termination == Termination::converged) {
    fit->termination = Termination::no_progress;
    fit->notes.emplace_back("no two searches agree on the lowest cost, so it is not taken for it");
  }
  return fit;
}

Result<OdeFit> solved(const std::vector<OdeFitProblem>& copies, const ServoSettings& settings) {
  if (settings.searches > 0) return from_search(copies, settings);
  if (settings.starts > 1) return from_many(copies.front(), settings);
  return fit_ode(copies.front(), OdeFitMethod::single_shooting, how_to_fit(settings));
}

/// A load that sticks or lets go by a hair does otherwise in the next simulation.
void judge_steadiness(const OdeFitProblem& problem, const ServoSettings& settings, OdeFit& fit) {
  std::vector<double> q;
  for (const ParameterEstimate& one : fit.parameters) q.push_back(one.value);
  auto how = how_to_fit(settings);
  for (int finer = 0; finer < 2; ++finer, how.integration_tolerance *= kFiner) {
    const auto cost = ode_cost(problem, how, q);
    const bool same = cost && std::abs(*cost - fit.cost) <= kSteady * fit.cost + kNothing;
    if (same) continue;
    fit.notes.push_back(fmt::format(
        "the fit ends on a cliff: of cost {:.4g}, simulated again at a tolerance of {:g} {}: the "
        "load sticks or lets go by a hair",
        fit.cost, how.integration_tolerance,
        cost ? fmt::format("{:.4g}", *cost) : "without a result"));
    if (fit.termination == Termination::converged) fit.termination = Termination::no_progress;
    return;
  }
}

}  // namespace

Result<OdeFit> solve_servo(const std::vector<OdeFitProblem>& copies,
                           const ServoSettings& settings) {
  if (settings.searches > 0 && settings.starts > 1) {
    return failure(
        ErrorCode::usage,
        fmt::format("both {} searches and {} starts", settings.searches, settings.starts),
        "the fit starts where the best search ends: leave out one of them");
  }
  auto fit = solved(copies, settings);
  if (fit) judge_steadiness(copies.front(), settings, *fit);
  return fit;
}

}  // namespace flexspline::estimators
