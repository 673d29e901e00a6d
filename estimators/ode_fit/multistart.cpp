#include "flexspline/estimators/multistart.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <fmt/format.h>

#include "ode_fit/home_rate.hpp"

namespace flexspline::estimators {
namespace {

double drawn(const OdeParameter& parameter, double spread, std::mt19937_64& engine) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const double u = uniform(engine);
  const double value =
      parameter.start == 0.0 ? spread * parameter.scale * u : parameter.start * std::pow(spread, u);
  return std::clamp(value, parameter.lower, parameter.upper);
}

// A stream of random numbers a start, so that more starts do not change the first ones.
OdeFitProblem started(const OdeFitProblem& problem, const MultistartSettings& settings, int start) {
  OdeFitProblem moved = problem;
  if (start == 0) return moved;
  std::seed_seq seeds{static_cast<std::uint32_t>(settings.seed),
                      static_cast<std::uint32_t>(settings.seed >> 32),
                      static_cast<std::uint32_t>(start)};
  std::mt19937_64 engine(seeds);
  for (auto& parameter : moved.parameters) {
    parameter.start = drawn(parameter, settings.spread, engine);
  }
  for (auto& experiment : moved.experiments) {
    for (auto& initial : experiment.initial) {
      auto* parameter = std::get_if<OdeParameter>(&initial);
      if (parameter != nullptr) parameter->start = drawn(*parameter, settings.spread, engine);
    }
  }
  return moved;
}

// The best of those that converged, if any did.
const OdeFit& best_of(const std::vector<OdeFit>& fits) {
  const auto order = [](const OdeFit& fit) {
    return std::pair(fit.termination != Termination::converged, fit.cost);
  };
  return *std::ranges::min_element(fits, {}, order);
}

int at_best(const std::vector<OdeFit>& fits, double same_cost) {
  if (fits.empty()) return 0;
  const double most = best_of(fits).cost * (1.0 + same_cost);
  return static_cast<int>(std::ranges::count_if(fits, [&](const OdeFit& fit) {
    return fit.termination == Termination::converged && fit.cost <= most;
  }));
}

void count(const MultistartSettings& settings, const std::vector<OdeFit>& fits,
           Multistart& result) {
  for (const auto& fit : fits) {
    result.costs.push_back(fit.cost);
    result.converged += fit.termination == Termination::converged;
  }
  result.at_best = at_best(fits, settings.same_cost);
  const HomeRate home = home_rate(result.at_best, result.starts);
  result.rate = home.rate;
  result.rate_lower = home.lower;
  result.rate_upper = home.upper;
  result.says = fmt::format(
      "{} of {} starts end at the best cost found, {} converge elsewhere, {} fail: from such "
      "starts "
      "{:.0f} % converge to it (95 %: {:.0f} to {:.0f} %)",
      result.at_best, result.starts, result.converged - result.at_best,
      result.starts - result.converged, 100.0 * result.rate, 100.0 * result.rate_lower,
      100.0 * result.rate_upper);
}

}  // namespace

Result<Multistart> fit_ode_from_many(const OdeFitProblem& problem, OdeFitMethod method,
                                     const OdeFitSettings& settings,
                                     const MultistartSettings& multistart) {
  if (multistart.starts < 2 || !(multistart.spread > 1.0)) {
    return failure(
        ErrorCode::usage,
        fmt::format("{} starts with a spread of {}", multistart.starts, multistart.spread),
        "give at least 2 starts and a spread above 1");
  }
  std::vector<OdeFit> fits;
  std::optional<Error> last;
  int made = 0;
  for (; made < multistart.starts; ++made) {
    if (multistart.enough > 0 && at_best(fits, multistart.same_cost) >= multistart.enough) break;
    OdeFitSettings own = settings;
    if (made > 0) own.equation_error_start = false;
    auto fit = fit_ode(started(problem, multistart, made), method, own);
    if (fit) {
      fits.push_back(std::move(*fit));
    } else {
      last = fit.error();
      if (last->code != ErrorCode::numerics) return tl::unexpected(*last);
    }
  }
  if (fits.empty()) return tl::unexpected(in_context(*last, "every initial guess"));
  Multistart result{.best = best_of(fits), .starts = made};
  result.failed = made - static_cast<int>(fits.size());
  count(multistart, fits, result);
  result.best.notes.push_back(result.says);
  if (result.at_best < 2 && result.best.termination == Termination::converged) {
    result.best.termination = Termination::no_progress;
    result.best.notes.emplace_back(
        "no two starts agree on the minimum, so it is not taken for one");
  }
  return result;
}

}  // namespace flexspline::estimators
