#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <random>

#include <fmt/format.h>

#include "flexspline/core/in_parallel.hpp"
#include "flexspline/estimators/ode_search.hpp"
#include "ode_fit/check.hpp"
#include "ode_fit/home_rate.hpp"
#include "ode_fit/weighted_shooting.hpp"
#include "solvers/evolution.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLeast = 1e-3;  // of a start, for numbers searched by their logarithm

bool by_logarithm(const OdeParameter& one) { return one.start > 0.0 && one.lower >= 0.0; }

double coordinate(const OdeParameter& one, double value) {
  return by_logarithm(one) ? std::log(value) : value / one.scale;
}

/// How far a start may be drawn, in its coordinate.
double width_of(const OdeParameter& one, const OdeSearchSettings& search) {
  const auto own = search.spreads.find(one.name);
  const double spread = own != search.spreads.end() ? own->second : search.spread;
  return by_logarithm(one) ? std::log(spread) : spread;
}

/// The cost of one copy of the problem.
class Cost {
 public:
  Cost(const OdeFitProblem& problem, const OdeFitSettings& settings)
      : layout_(lay_out(problem, settings)),
        shots_(layout_, settings.integration_tolerance, 1),
        problem_(layout_, shots_) {}
  Cost(const Cost&) = delete;
  Cost& operator=(const Cost&) = delete;

  const std::vector<OdeParameter>& unknowns() const { return layout_.unknowns; }

  std::vector<double> values(const Eigen::VectorXd& coordinates) const {
    std::vector<double> q;
    for (Eigen::Index k = 0; k < coordinates.size(); ++k) {
      const OdeParameter& one = layout_.unknowns[static_cast<std::size_t>(k)];
      const double x = coordinates[k];
      q.push_back(
          std::clamp(by_logarithm(one) ? std::exp(x) : one.scale * x, one.lower, one.upper));
    }
    return q;
  }

  /// Infinite where the candidate cannot be integrated.
  double at(const Eigen::VectorXd& coordinates) const {
    const auto cost = problem_.data_cost(values(coordinates));
    return cost && std::isfinite(*cost) ? *cost : kInfinity;
  }

 private:
  OdeLayout layout_;
  ShootingProblem shots_;
  WeightedShooting problem_;
};

using Costs = std::vector<std::unique_ptr<Cost>>;

std::vector<double> costs_of(const Costs& copies, const Eigen::MatrixXd& candidates) {
  std::vector<double> list(static_cast<std::size_t>(candidates.cols()));
  std::atomic<std::size_t> next = 0;
  in_parallel(copies.size(), copies.size(), [&](std::size_t copy) {
    for (std::size_t k = next++; k < list.size(); k = next++)
      list[k] = copies[copy]->at(candidates.col(static_cast<Eigen::Index>(k)));
  });
  return list;
}

// A stream of random numbers a search, so that more of them do not change the first ones.
std::vector<SearchedNumber> numbers_of(const std::vector<OdeParameter>& unknowns,
                                       const OdeSearchSettings& search, int index) {
  std::seed_seq seeds{static_cast<std::uint32_t>(search.seed),
                      static_cast<std::uint32_t>(search.seed >> 32),
                      static_cast<std::uint32_t>(index)};
  std::mt19937_64 engine(seeds);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<SearchedNumber> list;
  for (const OdeParameter& one : unknowns) {
    const double lower = by_logarithm(one) ? std::max(one.lower, kLeast * one.start) : one.lower;
    const double width = width_of(one, search);
    SearchedNumber number{coordinate(one, one.start), coordinate(one, lower),
                          coordinate(one, one.upper), 0.5 * width};
    const double u = index == 0 ? 0.0 : uniform(engine);
    number.start = std::clamp(number.start + width * u, number.lower, number.upper);
    list.push_back(number);
  }
  return list;
}

void count(OdeSearch& result, double same_cost) {
  const double most = result.cost * (1.0 + same_cost);
  result.at_best =
      static_cast<int>(std::ranges::count_if(result.costs, [&](double c) { return c <= most; }));
  const int searches = static_cast<int>(result.costs.size());
  const HomeRate home = home_rate(result.at_best, searches);
  result.says = fmt::format(
      "{} of {} searches without derivatives ({} simulations) end within {:.3g} % of the best cost "
      "they found: {:.0f} % (95 %: {:.0f} to {:.0f} %)",
      result.at_best, searches, result.evaluations, 100.0 * same_cost, 100.0 * home.rate,
      100.0 * home.lower, 100.0 * home.upper);
}

Result<void> check(const OdeSearchSettings& search, std::size_t copies) {
  if (copies > 0 && search.searches > 0 && search.evaluations > 0 && search.spread > 1.0) return {};
  return failure(ErrorCode::usage,
                 fmt::format("{} searches of {} evaluations with a spread of {}", search.searches,
                             search.evaluations, search.spread),
                 "give at least one of each and a spread above 1");
}

}  // namespace

Result<OdeSearch> search_ode(std::span<const OdeFitProblem> copies, const OdeFitSettings& settings,
                             const OdeSearchSettings& search) {
  if (auto good = check(search, copies.size()); !good) return tl::unexpected(good.error());
  if (auto good = check(settings); !good) return tl::unexpected(good.error());
  Costs costs;
  for (const OdeFitProblem& one : copies) {
    if (auto good = check(one); !good) return tl::unexpected(good.error());
    costs.push_back(std::make_unique<Cost>(one, settings));
  }
  OdeSearch result{.best = {}, .cost = kInfinity, .costs = {}, .says = {}};
  for (int k = 0; k < search.searches; ++k) {
    const auto numbers = numbers_of(costs.front()->unknowns(), search, k);
    const auto found = evolve(
        [&](const auto& candidates) { return costs_of(costs, candidates); }, numbers,
        {.evaluations = search.evaluations, .seed = search.seed + static_cast<std::uint64_t>(k)});
    result.evaluations += found.evaluations;
    result.costs.push_back(found.cost);
    if (found.cost >= result.cost) continue;
    result.cost = found.cost;
    result.best = costs.front()->values(found.best);
  }
  if (result.best.empty()) {
    return failure(ErrorCode::numerics, "no candidate of the search can be integrated",
                   "start nearer to what was recorded");
  }
  count(result, search.same_cost);
  return result;
}

Result<double> ode_cost(const OdeFitProblem& problem, const OdeFitSettings& settings,
                        std::span<const double> unknowns) {
  const OdeLayout layout = lay_out(problem, settings);
  const ShootingProblem shots(layout, settings.integration_tolerance, 1);
  return WeightedShooting(layout, shots).data_cost(unknowns);
}

}  // namespace flexspline::estimators
