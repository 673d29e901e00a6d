#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "torque_driven/crew.hpp"
#include "torque_driven/driven_fit.hpp"
#include "torque_driven/driven_nlp.hpp"
#include "torque_driven/integration_plan.hpp"

namespace flexspline::estimators {
namespace {

constexpr double kRoughDecrease = 1e-4;  // of shooting, that ends the warm start
constexpr std::size_t kMostParts = 32;
constexpr std::size_t kReach = 3;  // intervals before an error that may have brought it
constexpr int kMostMeshes = 4;
// A system at rest starts with a layer, at first steeper than any that follows.
constexpr std::size_t kFirstParts[] = {4, 2};

using Series = std::vector<std::vector<double>>;
using Parts = std::vector<std::vector<std::size_t>>;

Parts first_parts(const DrivenProblem& problem) {
  Parts parts;
  for (const auto& one : problem.series) {
    parts.emplace_back(one.intervals(), 1);
    std::ranges::copy(kFirstParts, parts.back().begin());
  }
  return parts;
}

std::vector<DrivenMesh> meshes_of(const DrivenProblem& problem, const Parts& parts) {
  std::vector<DrivenMesh> meshes;
  for (std::size_t s = 0; s < parts.size(); ++s) {
    meshes.push_back(driven_mesh(problem.series[s], parts[s]));
  }
  return meshes;
}

/// Coefficients, then the motions at all points but the first, between samples on straight lines.
std::vector<double> packed(std::vector<double> x, const DrivenProblem& problem, const Parts& parts,
                           const Series& states) {
  for (std::size_t s = 0; s < parts.size(); ++s) {
    double before = problem.series[s].initial;
    for (std::size_t n = 0; n < states[s].size(); ++n) {
      for (std::size_t k = 1; k <= parts[s][n]; ++k) {
        const double share = static_cast<double>(k) / static_cast<double>(parts[s][n]);
        x.push_back(before + share * (states[s][n] - before));
      }
      before = states[s][n];
    }
  }
  return x;
}

/// Divides what does not follow the integrated motions; the error of an interval is of order 4 in
/// its width. Returns the largest error found, over the peaks.
Refinement divide(const DrivenProblem& problem, const std::vector<DrivenMesh>& meshes,
                  std::span<const double> x, const Series& states, double tolerance, Parts& parts) {
  Refinement found;
  std::size_t at = problem.size();
  for (std::size_t s = 0; s < meshes.size(); ++s) {
    const auto old = parts[s];
    for (std::size_t n = 0; n < states[s].size(); ++n) {
      const double motion = x[at + meshes[s].sample[n + 1] - 1];
      const double error = problem.series[s].weight[n + 1] * std::abs(motion - states[s][n]);
      found.error = std::max(found.error, error);
      if (error <= tolerance) continue;
      const auto factor = static_cast<std::size_t>(std::ceil(std::pow(error / tolerance, 0.25)));
      for (std::size_t k = n - std::min(n, kReach); k <= n; ++k) {
        parts[s][k] = std::max(parts[s][k], std::min(kMostParts, factor * old[k]));
      }
    }
    found.changed = found.changed || parts[s] != old;
    at += meshes[s].points() - 1;
  }
  return found;
}

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
// the mesh cannot follow shows against the integrator and is divided.
Result<DrivenFit> fit_by_collocation(const DrivenProblem& problem, std::vector<double> p,
                                     const DrivenSettings& settings) {
  Crew crew(std::min(settings.threads, static_cast<int>(problem.series.size())));
  IntegrationPlan plan(problem, p, settings.instructions, crew);
  DrivenFit fit{.p = std::move(p), .at = {}};
  NlpSettings nlp_settings{.tolerance = 1e-9, .max_iterations = settings.max_iterations};
  nlp_settings.objective_scale = 1.0 / cost_of_nothing(problem);
  fit.p = gauss_newton(std::move(fit.p), evaluation_by(problem, plan),
                       {.max_iterations = settings.max_iterations, .decrease = kRoughDecrease})
              .p;
  plan.refine(fit.p, settings.tolerance);
  Parts parts = first_parts(problem);
  for (int round = 0; round < kMostMeshes; ++round) {
    const auto meshes = meshes_of(problem, parts);
    const auto start = packed(fit.p, problem, parts, plan.states(fit.p));
    const auto found = minimise(DrivenNlp(problem, meshes), start, nlp_settings);
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
    const auto looked =
        divide(problem, meshes, found->x, plan.states(fit.p), settings.tolerance, parts);
    fit.integration_error = looked.error;
    if (!looked.changed || fit.termination != Termination::converged) break;
  }
  return fit;
}

}  // namespace flexspline::estimators
