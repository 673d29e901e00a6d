#include "given_model/given_search.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "flexspline/core/effect.hpp"
#include "flexspline/core/effect_dependence.hpp"
#include "given_model/given_draw.hpp"
#include "given_model/given_start.hpp"
#include "ode_fit/home_rate.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kStepOfScale = 1e-2;  // of a scale: the size that differences of an unknown near
                                       // zero are taken by
constexpr double kSameCost = 1e-3;     // relative difference of costs that is none

/// An effect that looks at the torque makes every other number non-linear.
bool follows_torque(const EffectSpec& spec) {
  const auto row = find_effect(spec.effect);
  if (!row) return false;
  const auto values = parameter_values(**row, spec);
  return values && depends_on(**row, *values, &Instant<Complex>::transmitted_torque);
}

/// The start of all unknowns: first without the effects that follow the torque.
Result<std::vector<double>> start_of(const ModelSpec& model,
                                     const std::vector<GivenParameter>& parameters,
                                     const std::vector<GivenRecord>& records, bool each_zero,
                                     const GivenResiduals& whole, int steps) {
  ModelSpec reduced = model;
  std::vector<bool> kept(parameters.size(), true);
  std::size_t k = parameters.size();
  for (const EffectSpec& spec : model.effects) k -= spec.parameters.size();
  reduced.effects.clear();
  for (const EffectSpec& spec : model.effects) {
    const bool drop = follows_torque(spec);
    for (std::size_t j = 0; j < spec.parameters.size(); ++j) kept[k++] = !drop;
    if (!drop) reduced.effects.push_back(spec);
  }
  std::vector<GivenParameter> some;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (kept[i]) some.push_back(parameters[i]);
  }
  const GivenResiduals problem(reduced, some, records, each_zero);
  const auto found = given_start(problem, steps);
  if (!found) return found;
  std::vector<double> start;
  std::size_t next = 0;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i].held) continue;
    start.push_back(kept[i] ? (*found)[next++] : parameters[i].start);
  }
  while (start.size() < whole.unknowns().size()) start.push_back((*found)[next++]);
  return start;
}

std::vector<BoundedParameter> bounded(const GivenResiduals& problem,
                                      const std::vector<double>& start, const Linearisation& at,
                                      double effort) {
  std::vector<BoundedParameter> list;
  for (std::size_t k = 0; k < start.size(); ++k) {
    const GivenParameter& one = problem.unknowns()[k];
    const double slope = at.jacobian.col(static_cast<Eigen::Index>(k)).norm() /
                         std::sqrt(static_cast<double>(at.jacobian.rows()));
    const double scale = slope > 0.0 ? effort / slope : 1.0;
    list.push_back({std::clamp(start[k], one.lower, one.upper), one.lower, one.upper,
                    std::max(scale, 1e-3 * std::abs(start[k]))});
  }
  return list;
}

/// All unknowns together from a start, in scales by what they move the torque.
Result<LeastSquaresSolution> solved(GivenResiduals& residuals, const std::vector<double>& start,
                                    double effort, int iterations) {
  const auto at_start = linearise(residuals, start);
  if (!at_start) return tl::unexpected(at_start.error());
  const auto unknowns = bounded(residuals, start, *at_start, effort);
  std::vector<double> sizes;
  for (const auto& one : unknowns) sizes.push_back(kStepOfScale * one.scale);
  residuals.set_sizes(sizes);
  return minimise(residuals, unknowns, {.max_iterations = iterations, .function_tolerance = 1e-9});
}

/// From where the search of the shapes leads, and from the shapes given.
Result<GivenSearch> solved_from(const ModelSpec& model,
                                const std::vector<GivenParameter>& parameters,
                                const std::vector<GivenRecord>& records,
                                const GivenSearchSettings& settings) {
  std::optional<GivenSearch> best;
  for (const int most : std::set{0, settings.start_steps}) {
    GivenResiduals residuals(model, parameters, records, settings.each_zero);
    const auto start = start_of(model, parameters, records, settings.each_zero, residuals, most);
    if (!start) return tl::unexpected(start.error());
    auto solution = solved(residuals, *start, rms_effort(records), settings.iterations);
    if (!solution) return tl::unexpected(solution.error());
    if (best && solution->cost >= best->solution.cost) continue;
    best.emplace(GivenSearch{std::move(residuals), std::move(*solution)});
  }
  return std::move(*best);
}

void judge(const std::vector<double>& costs, int starts, GivenSearch& found) {
  const double most = (1.0 + kSameCost) * found.solution.cost;
  const auto home =
      static_cast<int>(std::ranges::count_if(costs, [&](double cost) { return cost <= most; }));
  const HomeRate rate = home_rate(home, starts);
  found.says = fmt::format(
      "{} of {} starts end at the lowest cost found: {:.0f} % converge to it (95 %: {:.0f} to "
      "{:.0f} %)",
      home, starts, 100.0 * rate.rate, 100.0 * rate.lower, 100.0 * rate.upper);
  if (home > 1 || found.solution.termination != Termination::converged) return;
  found.solution.termination = Termination::no_progress;
  found.says += "; no two agree on it, so it is not taken for the minimum";
}

}  // namespace

Result<GivenSearch> search_given(const ModelSpec& model,
                                 const std::vector<GivenParameter>& parameters,
                                 const std::vector<GivenRecord>& records,
                                 const GivenSearchSettings& settings) {
  std::optional<GivenSearch> best;
  std::vector<double> costs;
  for (int k = 0; k < settings.starts; ++k) {
    const int start = settings.first_start + k;
    auto found =
        solved_from(model, drawn_start(parameters, settings.seed, start), records, settings);
    if (!found && (start == 0 || settings.starts == 1)) return found;
    if (!found) continue;
    costs.push_back(found->solution.cost);
    if (!best || costs.back() < best->solution.cost) best.emplace(std::move(*found));
  }
  if (!best) {
    return failure(ErrorCode::numerics, "the model cannot be simulated at any of the starts",
                   "give the model numbers nearer to what was recorded");
  }
  if (settings.starts > 1) judge(costs, settings.starts, *best);
  return std::move(*best);
}

}  // namespace flexspline::estimators
