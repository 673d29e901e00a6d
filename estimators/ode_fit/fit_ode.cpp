#include <algorithm>

#include "flexspline/estimators/ode_fit.hpp"
#include "ode_fit/check.hpp"
#include "ode_fit/methods.hpp"
#include "ode_fit/noise.hpp"
#include "ode_fit/statistics.hpp"

namespace flexspline::estimators {
namespace {

constexpr int kWeighings = 25;
constexpr double kSettled = 1e-7;  // relative change of a weight

Result<OdeSolution> solve(const OdeLayout& layout, OdeFitMethod method,
                          const OdeFitSettings& settings) {
  switch (method) {
    case OdeFitMethod::multiple_shooting:
      return multiple_shooting(layout, settings);
    case OdeFitMethod::collocation:
      return collocation(layout, settings);
    default:
      return single_shooting(layout, settings);
  }
}

std::vector<bool> on_bounds(const OdeLayout& layout, const OdeSolution& solution) {
  auto q = solution.q;
  return settle_on_bounds(layout, q);
}

void start_at(OdeLayout& layout, const std::vector<double>& q) {
  for (std::size_t k = 0; k < q.size(); ++k) {
    auto& unknown = layout.unknowns[k];
    unknown.start = std::clamp(q[k], unknown.lower, unknown.upper);
  }
}

// Maximum likelihood over parameters and noise, one after the other until both stay.
Result<OdeSolution> solve_and_weigh(OdeLayout& layout, OdeFitMethod method,
                                    const OdeFitSettings& settings,
                                    std::vector<OutputNoise>& noise) {
  auto solution = solve(layout, method, settings);
  if (settings.weighting == Weighting::given) return solution;
  for (int round = 0; solution && round < kWeighings; ++round) {
    const auto change =
        weigh_anew(layout, solution->q, on_bounds(layout, *solution), settings, noise);
    if (!change) return tl::unexpected(change.error());
    start_at(layout, solution->q);
    const int iterations = solution->iterations;
    const long evaluations = solution->evaluations;
    solution = solve(layout, method, settings);
    if (!solution) break;
    solution->iterations += iterations;
    solution->evaluations += evaluations;
    if (*change < kSettled) return solution;
  }
  if (solution) solution->notes.emplace_back("the weights of the outputs have not settled");
  return solution;
}

std::size_t most_outputs(const OdeLayout& layout) {
  std::size_t most = 0;
  for (const auto& experiment : layout.experiments) most = std::max(most, experiment.outputs());
  return most;
}

}  // namespace

std::string_view name_of(OdeFitMethod method) {
  switch (method) {
    case OdeFitMethod::multiple_shooting:
      return "multiple_shooting";
    case OdeFitMethod::collocation:
      return "collocation";
    default:
      return "single_shooting";
  }
}

Result<OdeFit> fit_ode(const OdeFitProblem& problem, OdeFitMethod method,
                       const OdeFitSettings& settings) {
  if (auto checked = check(settings); !checked) return tl::unexpected(std::move(checked).error());
  if (auto checked = check(problem); !checked) return tl::unexpected(std::move(checked).error());
  OdeLayout layout = lay_out(problem, settings);
  std::vector<OutputNoise> noise(most_outputs(layout));
  auto solution = solve_and_weigh(layout, method, settings, noise);
  if (!solution) {
    return tl::unexpected(in_context(std::move(solution).error(), std::string(name_of(method))));
  }
  auto fit = with_statistics(layout, *solution, settings);
  if (!fit) return tl::unexpected(in_context(fit.error(), std::string(name_of(method))));
  // Refits of a bootstrap weigh anew themselves; inequalities leave no free parameters to widen.
  if (settings.weighting == Weighting::coloured && layout.inequalities == nullptr &&
      settings.uncertainty.kind == Uncertainty::covariance) {
    std::vector<double> q = solution->q;
    const auto active = settle_on_bounds(layout, q);
    const auto widened =
        widen_for_noise(layout, q, active, settings.integration_tolerance, noise, *fit);
    if (!widened) return tl::unexpected(widened.error());
  }
  fit->method = method;
  fit->noise = std::move(noise);
  return fit;
}

}  // namespace flexspline::estimators
