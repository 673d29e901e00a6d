#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "flexspline/estimators/method.hpp"
#include "posterior/judge_fit.hpp"
#include "torsion/free_terms.hpp"
#include "torsion/trajectory_fit.hpp"
#include "uncertainty/bands.hpp"
#include "uncertainty/estimate_parts.hpp"
#include "uncertainty/torsion_intervals.hpp"

namespace flexspline::estimators {

MethodRow describe_trajectory_ceres();

namespace {

constexpr double kMisses = 1.5;  // residual over noise from which a model misses something

// f need not pass the origin of a joint that travels, and a specimen's zero is where it was
// clamped.
FreeTerms base_terms(const std::vector<PreparedRecord>& records) {
  FreeTerms base;
  const bool travels = records.front().record.travels;
  const double range = ranges_of(records, true).motion;
  for (const auto& one : records) {
    if (!travels && std::abs(centre_of(one)) > 0.05 * range) base.zeros = true;
  }
  base.offset = !travels;
  return base;
}

// Where the motion is imposed and free to travel eq. (3) has no spring that brings it back; and a
// model that misses the torque by more than the noise drifts away from the torsion.
Direction direction_of(const FitProblem& problem, const MethodRow& method, bool misses) {
  const std::string asked = word(problem, method, "simulate");
  if (asked != "auto") return asked == "torque" ? Direction::torque : Direction::torsion;
  const auto& record = problem.records.front();
  return record.travels || record.linear || misses ? Direction::torque : Direction::torsion;
}

std::vector<ParameterEstimate> parameters_of(const TrajectoryFit& fit, bool angular) {
  const TorsionLayout& layout = fit.at.layout;
  std::vector<ParameterEstimate> list;
  for (std::size_t k = 0; k < fit.solution.p.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    list.push_back(parameter_estimate(layout.name(k), layout.unit(k, angular), fit.solution.p[k],
                                      fit.covariance(i, i), fit.solution.bound_active[k]));
  }
  return list;
}

Estimate estimate_of(const TrajectoryFit& fit, const std::vector<PreparedRecord>& records,
                     const TermDecision& decision) {
  const Ranges ranges = ranges_of(records, fit.at.layout.free_terms().zeros);
  Estimate estimate;
  estimate.estimator = "trajectory_ceres";
  estimate.model = fit.at.layout.model(fit.solution.p);
  estimate.parameters = parameters_of(fit, !records.front().record.linear);
  estimate.termination = fit.solution.termination;
  estimate.cost = fit.solution.cost;
  estimate.residual =
      fit.direction == Direction::torsion
          ? "torsion: innovations of eq. (3) integrated from the measured torque, in "
            "standard deviations of their noise"
          : "torque: eq. (4) along the measured motion, in standard deviations of "
            "its noise";
  estimate.fits = recording_fits(records, fit.linear.residual);
  estimate.identifiability = {decision.condition, decision.absorbed, decision.verdict,
                              decision.says};
  const Domain domain{ranges.lowest_motion, ranges.highest_motion, ranges.velocity};
  const Eigen::MatrixXd draws = draws_at_bounds(fit, records);
  estimate.bands = draws.rows() > 0
                       ? torsion_bands(fit.at.layout, fit.solution.p, draws, domain, DrawnBands())
                       : torsion_bands(fit.at.layout, fit.solution.p, fit.covariance, domain);
  estimate.notes = decision.notes;
  estimate.evaluations = fit.solution.evaluations;
  return estimate;
}

std::string misfit_note(const Leftover& left) {
  return fmt::format(
      "eq. (4) with these laws leaves {:.3g} times the noise of the recordings: "
      "something is left out",
      left.residual / left.noise);
}

UncertaintySettings uncertainty_of(const FitProblem& problem, const MethodRow& method) {
  return {.kind = *find_uncertainty(word(problem, method, "uncertainty")),
          .replicates = static_cast<std::size_t>(number(problem, method, "replicates")),
          .seed = static_cast<std::uint64_t>(number(problem, method, "seed"))};
}

void take(const Intervals& found, Estimate& estimate) {
  for (std::size_t k = 0; k < found.lower.size(); ++k) {
    estimate.parameters[k].ci95_lower = found.lower[k];
    estimate.parameters[k].ci95_upper = found.upper[k];
    if (!found.std.empty()) estimate.parameters[k].std = found.std[k];
  }
  estimate.notes.insert(estimate.notes.end(), found.notes.begin(), found.notes.end());
}

// Bands and verdict by what the recordings say without the classes of the laws.
void judge(const std::vector<PreparedRecord>& records, const TrajectoryFit& fit, bool with_h,
           Estimate& estimate) {
  const auto posterior = torsion_posterior(records, fit.at.layout, fit.at.p, with_h);
  if (!posterior) {
    estimate.notes.push_back("the bands count the classes of f, g^-1 and h as known: " +
                             posterior.error().message());
    return;
  }
  const Ranges ranges = ranges_of(records, false);
  auto result = judged(*posterior, fit.at.layout, fit.at.p,
                       {ranges.lowest_motion, ranges.highest_motion, ranges.velocity},
                       std::move(estimate.identifiability));
  estimate.bands = std::move(result.bands);
  estimate.identifiability = std::move(result.identifiability);
}

Result<Estimate> fit(const FitProblem& problem) {
  const auto started = std::chrono::steady_clock::now();
  const MethodRow method = describe_trajectory_ceres();
  if (problem.records.empty()) {
    return failure(ErrorCode::bad_data, "there is no recording to train on",
                   "mark one with split = \"train\"");
  }
  auto records =
      prepare(problem.records, static_cast<std::size_t>(number(problem, method, "samples")));
  if (!records) return tl::unexpected(records.error());
  const bool travels = records->front().record.travels;
  const AllowedTerms allowed{.h = !travels && word(problem, method, "h") == "auto",
                             .inertia = !travels && word(problem, method, "inertia") == "auto",
                             .delay = word(problem, method, "delay") == "auto"};
  const FreeTerms base = base_terms(*records);
  const auto richest = richest_start(*records, base);
  if (!richest) return tl::unexpected(richest.error());
  if (auto added = add_motion_noise(*records, *richest); !added) {
    return tl::unexpected(added.error());
  }
  auto decision = decide_terms(*richest, *records, base, allowed);
  if (!decision) return tl::unexpected(decision.error());
  if (travels) decision->says = "h = 1: over a motion that travels it would be a second f";
  auto start = chosen_start(*records, base, *richest, decision->free);
  if (!start) return tl::unexpected(start.error());

  const SolverSettings settings{.max_iterations =
                                    static_cast<int>(number(problem, method, "iterations"))};
  auto result = fit_torque(with_terms(*start, decision->free), *records, settings);
  if (!result) return tl::unexpected(result.error());
  const Leftover left = leftover(*result, *records);
  const bool misses = left.residual > kMisses * left.noise;
  if (misses) {
    decision->notes.push_back(misfit_note(left));
    add_misfit(*records, left);
    start = chosen_start(*records, base, *richest, decision->free);
    if (!start) return tl::unexpected(start.error());
    result = fit_torque(with_terms(*start, decision->free), *records, settings);
  }
  const double tolerance = number(problem, method, "tolerance");
  const IntegratorSettings integrator{tolerance, tolerance, 200000};
  if (result && direction_of(problem, method, misses) == Direction::torsion) {
    result = fit_torsion(*result, *records, settings, integrator);
  }
  if (!result) return tl::unexpected(result.error());
  const auto found =
      torsion_intervals(*result, *records, uncertainty_of(problem, method), settings, integrator);
  if (!found) return tl::unexpected(found.error());
  if (found->covariance.size() > 0) result->covariance = found->covariance;
  Estimate estimate = estimate_of(*result, *records, *decision);
  take(*found, estimate);
  const bool by_law = found->covariance.size() == 0 && !travels && !base.zeros;
  if (by_law) judge(*records, *result, decision->free.h > 0, estimate);
  estimate.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return estimate;
}

}  // namespace

MethodRow describe_trajectory_ceres() {
  return {
      .id = "trajectory_ceres",
      .summary =
          "f, g^-1 and h of eq. (3) over whole recordings: CVODES with forward "
          "sensitivities inside Ceres",
      .source = "Dhaouadi and Ghorbel (2003), eqs. (3), (4); laws of the catalogue",
      .options = {{.name = "simulate",
                   .meaning = "what is simulated and compared: torsion by eq. (3) from the "
                              "torque, or torque by eq. (4) from the motion; auto: torsion, "
                              "but torque where an angle or a displacement is imposed or "
                              "where the model misses more than the noise",
                   .choices = {"auto", "torsion", "torque"}},
                  {.name = "h",
                   .meaning = "auto: fitted where the recordings can tell it; unity: h = 1",
                   .choices = {"auto", "unity"}},
                  {.name = "inertia",
                   .meaning = "an inertia torque that the sensor sees",
                   .choices = {"auto", "off"}},
                  {.name = "delay",
                   .meaning = "a delay of the torque against the angle",
                   .choices = {"auto", "off"}},
                  {.name = "tolerance",
                   .meaning = "relative and absolute tolerance of the integration",
                   .value = 1e-7,
                   .lower = 1e-12,
                   .upper = 1e-3},
                  {.name = "iterations",
                   .meaning = "most iterations of the solver",
                   .value = 60,
                   .lower = 1,
                   .upper = 10000},
                  {.name = "samples",
                   .meaning = "most residuals of one recording; longer ones are thinned evenly",
                   .value = 3000,
                   .lower = 100,
                   .upper = 1e6},
                  {.name = "uncertainty",
                   .meaning = "where intervals of parameters come from; bands of f, g^-1 and h "
                              "follow the bootstrap, else the covariance",
                   .choices = {"covariance", "profile", "bootstrap_parametric", "bootstrap_block"}},
                  {.name = "replicates",
                   .meaning = "refits of the bootstrap",
                   .value = 200,
                   .lower = 20,
                   .upper = 100000},
                  {.name = "seed",
                   .meaning = "of the bootstrap's random numbers",
                   .value = 1,
                   .lower = 0,
                   .upper = 9e15}},
      .fit = fit};
}

}  // namespace flexspline::estimators
