#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "ode_fit/collocation_nlp.hpp"
#include "ode_fit/equation_error.hpp"
#include "ode_fit/guess.hpp"
#include "ode_fit/inequalities.hpp"
#include "ode_fit/methods.hpp"

namespace flexspline::estimators {
namespace {

constexpr int kMeshes = 6;
constexpr double kMostParts = 8.0;
constexpr std::size_t kMostGrowth = 32;  // of the first mesh, beyond kFreeElements
constexpr std::size_t kFreeElements = 1000;
constexpr long kMostStepsInElement = 5000;
constexpr double kWarmBarrier = 1e-6;

std::vector<NodeStates> guessed(const OdeLayout& layout, const std::vector<Mesh>& meshes) {
  constexpr double kGuessTolerance = 1e-6;
  std::vector<NodeStates> result;
  for (std::size_t e = 0; e < meshes.size(); ++e) {
    std::vector<double> times = {meshes[e].ends.front()};
    for (std::size_t k = 0; k < meshes[e].elements() * kStages; ++k) {
      times.push_back(meshes[e].time(k / kStages, k % kStages));
    }
    const auto states = guess_states(layout, layout.experiments[e], times, kGuessTolerance);
    const auto split = states.begin() + static_cast<std::ptrdiff_t>(layout.states());
    result.push_back({layout.states(), {states.begin(), split}, {split, states.end()}});
  }
  return result;
}

// Error at the end of an element against the integrator from the same start, in state scales.
double element_error(const OdeLayout& layout, std::span<const double> p, const Mesh& mesh,
                     const NodeStates& states, std::size_t element, double tolerance) {
  const double times[] = {mesh.ends[element], mesh.ends[element + 1]};
  SystemSettings settings = layout.integration(tolerance);
  settings.max_steps = kMostStepsInElement;
  const auto exact = integrate_system(*layout.system, p, times, states.start_of(element), settings);
  if (!exact) return std::numeric_limits<double>::infinity();
  const auto end = states.at(element, kStages - 1);
  double error = 0.0;
  for (std::size_t i = 0; i < end.size(); ++i) {
    error =
        std::max(error, std::abs(exact->state[end.size() + i] - end[i]) / layout.state_scale[i]);
  }
  return error;
}

struct Refinement {
  std::vector<std::size_t> parts;
  double error = 0.0;
};

// The error of an element is of order 6 in its width.
Refinement refinement(const OdeLayout& layout, std::span<const double> p, const Mesh& mesh,
                      const NodeStates& states, double tolerance) {
  Refinement result;
  for (std::size_t e = 0; e < mesh.elements(); ++e) {
    const double error = element_error(layout, p, mesh, states, e, 0.01 * tolerance);
    result.error = std::max(result.error, error);
    const double parts = std::ceil(std::pow(error / tolerance, 1.0 / 6.0));
    result.parts.push_back(
        error <= tolerance ? 1 : static_cast<std::size_t>(std::clamp(parts, 2.0, kMostParts)));
  }
  return result;
}

// Divides what is too coarse. Returns the largest error before.
double refine(const OdeLayout& layout, std::span<const double> q, double tolerance,
              std::vector<Mesh>& meshes, std::vector<NodeStates>& states) {
  const auto p = q.first(layout.system->parameters());
  double error = 0.0;
  for (std::size_t e = 0; e < meshes.size(); ++e) {
    const auto found = refinement(layout, p, meshes[e], states[e], tolerance);
    error = std::max(error, found.error);
    if (found.error <= tolerance) continue;
    const Mesh fine = divided(meshes[e], found.parts);
    states[e] = transferred(states[e], meshes[e], fine);
    meshes[e] = fine;
  }
  return error;
}

std::size_t count(const std::vector<Mesh>& meshes) {
  std::size_t elements = 0;
  for (const Mesh& mesh : meshes) elements += mesh.elements();
  return elements;
}

void take(OdeSolution& solution, const NlpSolution& found) {
  solution.cost = found.objective;
  solution.termination = found.termination;
  solution.iterations += found.iterations;
  solution.evaluations += found.evaluations;
}

// The mesh follows the solution: solved on elements from measurement to measurement first, then
// again where an element's end is off.
Result<OdeSolution> collocate(const OdeLayout& layout, const TwiceOdeSystem& system,
                              std::vector<double> start, const OdeFitSettings& settings) {
  std::vector<Mesh> meshes;
  for (const auto& experiment : layout.experiments) meshes.push_back(first_mesh(experiment));
  std::vector<NodeStates> states = guessed(layout, meshes);
  const std::size_t most = kFreeElements + kMostGrowth * count(meshes);
  OdeSolution solution{.q = std::move(start)};
  NlpSettings nlp_settings{.max_iterations = settings.max_iterations};
  nlp_settings.objective_scale = 1.0 / std::max(cost_of_nothing(layout), 1e-300);
  for (int round = 0; round < kMeshes; ++round) {
    const CollocationNlp nlp(layout, system, meshes);
    solution.elements = nlp.elements();
    const auto found = minimise(nlp, nlp.pack(solution.q, states), nlp_settings);
    if (!found) {
      return tl::unexpected(
          in_context(found.error(), fmt::format("on {} elements", solution.elements)));
    }
    take(solution, *found);
    solution.q = nlp.unknowns(found->x);
    states = nlp.node_states(found->x);
    solution.gap = refine(layout, solution.q, settings.mesh_tolerance, meshes, states);
    if (solution.gap <= settings.mesh_tolerance) break;
    if (found->termination != Termination::converged || count(meshes) > most) break;
    nlp_settings.barrier_start = kWarmBarrier;
  }
  note_active_inequalities(layout, solution);
  if (solution.gap <= settings.mesh_tolerance) return solution;
  if (solution.termination == Termination::converged) {
    solution.termination = Termination::no_progress;
  }
  solution.notes.push_back(fmt::format("the mesh of {} elements is still off by {:.1g}",
                                       solution.elements, solution.gap));
  return solution;
}

}  // namespace

// The trajectory starts from the measurements; with parameters that fit them as well the way home
// is short. Where that way does not lead anywhere, the start that was given is left.
Result<OdeSolution> collocation(const OdeLayout& layout, const OdeFitSettings& settings) {
  const auto* system = dynamic_cast<const TwiceOdeSystem*>(layout.system.get());
  if (system == nullptr) {
    return failure(ErrorCode::usage, "collocation needs second derivatives of the system's law",
                   "derive the system from OdeLaw, or fit by shooting");
  }
  if (settings.equation_error_start) {
    const auto start = equation_error_start(layout);
    auto solution = start ? collocate(layout, *system, *start, settings) : Result<OdeSolution>{};
    if (start && solution && solution->termination == Termination::converged) return solution;
  }
  return collocate(layout, *system, layout.start(), settings);
}

}  // namespace flexspline::estimators
