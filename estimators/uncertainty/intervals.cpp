#include "uncertainty/intervals.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "flexspline/core/in_parallel.hpp"

namespace flexspline::estimators {
namespace {

// The parameters' profiles do not need each other: threads take them, rather than blocks.
std::vector<Result<ProfileInterval>> profiles_of(const FittedProblem& fit, SolverSettings solver) {
  std::vector<Result<ProfileInterval>> profiles(fit.p.size());
  const auto threads = static_cast<std::size_t>(std::max(1, solver.threads));
  solver.threads = 1;
  in_parallel(profiles.size(), threads, [&](std::size_t k) {
    profiles[k] =
        profile_interval(fit.problem, fit.parameters, fit.p, fit.covariance, k,
                         {.variance = fit.variances.empty() ? fit.variance : fit.variances[k],
                          .quantile = fit.quantile,
                          .tolerance = fit.tolerance,
                          .solver = solver});
  });
  return profiles;
}

Result<Intervals> by_profile(const FittedProblem& fit, const SolverSettings& solver) {
  Intervals result;
  std::size_t open = 0;
  for (const auto& one : profiles_of(fit, solver)) {
    if (!one) return tl::unexpected(one.error());
    open += one->lower_open || one->upper_open;
    result.lower.push_back(one->lower);
    result.upper.push_back(one->upper);
  }
  if (open > 0) {
    result.notes.push_back(
        fmt::format("the profile likelihood of {} of {} parameters is open on a side: the "
                    "recordings do not end the interval there, a bound or nothing does",
                    open, fit.p.size()));
  }
  return result;
}

Result<Intervals> by_bootstrap(const FittedProblem& fit, const UncertaintySettings& settings,
                               const SolverSettings& solver) {
  const bool blocks = settings.kind == Uncertainty::bootstrap_block;
  auto drawn = bootstrap(fit.problem, fit.parameters, fit.p,
                         {.resampling = blocks ? Resampling::block : Resampling::parametric,
                          .replicates = settings.replicates,
                          .seed = settings.seed,
                          .noise_known = fit.noise_known,
                          .series = fit.series,
                          .solver = solver});
  if (!drawn) return tl::unexpected(drawn.error());
  Intervals result{{}, std::move(drawn->lower), std::move(drawn->upper), {}, {}};
  for (const double variance : drawn->covariance.diagonal()) {
    result.std.push_back(std::sqrt(variance));
  }
  result.covariance = std::move(drawn->covariance);
  std::string note =
      fmt::format("intervals are percentiles of {} {} bootstrap replicates, seed {}",
                  drawn->replicate.rows(), blocks ? "block" : "parametric", settings.seed);
  if (blocks) {
    const auto [low, high] = std::ranges::minmax_element(drawn->block_length);
    note += fmt::format("; mean block length {:.1f} to {:.1f} rows", *low, *high);
  }
  if (drawn->failed > 0) note += fmt::format("; {} could not be fitted", drawn->failed);
  result.notes.push_back(std::move(note));
  return result;
}

}  // namespace

std::span<const Uncertainty> uncertainties() {
  static constexpr std::array kAll = {Uncertainty::covariance, Uncertainty::profile,
                                      Uncertainty::bootstrap_parametric,
                                      Uncertainty::bootstrap_block};
  return kAll;
}

std::string_view name_of(Uncertainty uncertainty) {
  switch (uncertainty) {
    case Uncertainty::profile:
      return "profile";
    case Uncertainty::bootstrap_parametric:
      return "bootstrap_parametric";
    case Uncertainty::bootstrap_block:
      return "bootstrap_block";
    default:
      return "covariance";
  }
}

std::optional<Uncertainty> find_uncertainty(std::string_view name) {
  for (const Uncertainty one : uncertainties()) {
    if (name_of(one) == name) return one;
  }
  return std::nullopt;
}

Result<Intervals> intervals(const FittedProblem& fit, const UncertaintySettings& settings,
                            const SolverSettings& solver) {
  switch (settings.kind) {
    case Uncertainty::covariance:
      return Intervals{};
    case Uncertainty::profile:
      return by_profile(fit, solver);
    default:
      return by_bootstrap(fit, settings, solver);
  }
}

}  // namespace flexspline::estimators
