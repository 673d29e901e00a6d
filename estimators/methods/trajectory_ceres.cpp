#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "flexspline/estimators/method.hpp"
#include "torsion/free_terms.hpp"
#include "torsion/torque_residuals.hpp"
#include "torsion/torsion_residuals.hpp"
#include "uncertainty/bands.hpp"
#include "uncertainty/covariance.hpp"

namespace flexspline::estimators {

MethodRow describe_trajectory_ceres();

namespace {

constexpr double kNormal95 = 1.959963984540054;
constexpr double kMaterial = 3.0;  // standard deviations from zero of a term that is kept

enum class Direction { torsion, torque };

// f need not pass the origin of a joint that travels, and a specimen's zero is where it was clamped.
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

Direction direction_of(const FitProblem& problem, const MethodRow& method,
                       const std::vector<PreparedRecord>& records) {
  const std::string asked = word(problem, method, "simulate");
  if (asked != "auto") return asked == "torque" ? Direction::torque : Direction::torsion;
  const auto& record = records.front().record;
  return record.travels || record.linear ? Direction::torque : Direction::torsion;
}

struct Fit {
  LinearStart at;
  LeastSquaresSolution solution;
  Eigen::MatrixXd covariance;
  Linearisation linear;
  Direction direction;
};

// Effort follows motion: the noise of the motion is part of its residual's, by the slope of the law.
Result<void> add_motion_noise(std::vector<PreparedRecord>& records, const LinearStart& at) {
  const TorqueResiduals problem(at.layout, records);
  for (std::size_t b = 0; b < records.size(); ++b) {
    const auto slopes = problem.motion_slope(b, at.p);
    if (!slopes) return tl::unexpected(slopes.error());
    for (std::size_t r = 0; r < slopes->size(); ++r) {
      records[b].effort_sigma[r] =
          std::hypot(records[b].effort_noise, (*slopes)[r] * records[b].motion_sigma);
    }
  }
  return {};
}

// The residuals have unit variance if the noises are what they were measured to be; where more is
// left, by colour or by what the model lacks, the covariance grows with it.
Eigen::MatrixXd covariance_of(const std::vector<PreparedRecord>& records, const Linearisation& at,
                              const std::vector<bool>& bound_active) {
  Eigen::MatrixXd middle = Eigen::MatrixXd::Zero(at.jacobian.cols(), at.jacobian.cols());
  Eigen::Index row = 0;
  for (const auto& one : records) {
    const auto height = static_cast<Eigen::Index>(one.rows.size());
    const Eigen::MatrixXd j = at.jacobian.middleRows(row, height);
    const Eigen::VectorXd r = at.residual.segment(row, height);
    const std::span<const double> series(r.data(), static_cast<std::size_t>(height));
    const double left = r.squaredNorm() / static_cast<double>(height) * long_run_ratio(series);
    middle += std::max(1.0, left) * j.transpose() * j;
    row += height;
  }
  return sandwich(at.jacobian, middle, bound_active);
}

Result<Fit> minimised(const LeastSquaresProblem& problem, LinearStart start,
                      const std::vector<PreparedRecord>& records, const SolverSettings& settings,
                      Direction direction) {
  const auto bounds = bounded_parameters(start.layout, records, start.p);
  auto solution = minimise(problem, bounds, settings);
  if (!solution) return tl::unexpected(solution.error());
  auto linear = linearise(problem, solution->p);
  if (!linear) return tl::unexpected(linear.error());
  Fit fit{std::move(start), std::move(*solution), {}, std::move(*linear), direction};
  fit.at.p = fit.solution.p;
  fit.covariance = covariance_of(records, fit.linear, fit.solution.bound_active);
  return fit;
}

Result<Fit> fit_torque(const LinearStart& start, const std::vector<PreparedRecord>& records,
                       const SolverSettings& settings) {
  const TorqueResiduals problem(start.layout, records);
  return minimised(problem, start, records, settings, Direction::torque);
}

// Offset, inertia, delay and the highest terms of ln h that lie within three standard deviations of
// zero: kept, they would only pass their uncertainty on to g^-1. ln h keeps two terms.
FreeTerms significant_terms(const Fit& fit) {
  const TorsionLayout& layout = fit.at.layout;
  auto far_from_zero = [&](std::size_t k) {
    const auto i = static_cast<Eigen::Index>(k);
    return std::abs(fit.solution.p[k]) > kMaterial * std::sqrt(fit.covariance(i, i));
  };
  auto keep = [&](const Group& group) { return group.present() && far_from_zero(group.first); };
  FreeTerms free = layout.free_terms();
  free.offset = keep(layout.offset_group);
  free.inertia = keep(layout.inertia_group);
  free.delay = keep(layout.delay_group);
  if (free.h > kFewestModulationTerms && !far_from_zero(layout.h_group.first + free.h - 1)) {
    --free.h;
  }
  return free;
}

bool same(const FreeTerms& a, const FreeTerms& b) {
  return a.h == b.h && a.offset == b.offset && a.inertia == b.inertia && a.delay == b.delay;
}

// Eq. (4), with the terms that do not tell themselves from zero taken out one round after another.
Result<Fit> fit_torque_pruned(const LinearStart& start, const std::vector<PreparedRecord>& records,
                              const SolverSettings& settings) {
  auto fit = fit_torque(start, records, settings);
  while (fit) {
    const FreeTerms kept = significant_terms(*fit);
    if (same(kept, fit->at.layout.free_terms())) break;
    fit = fit_torque(with_terms(fit->at, kept), records, settings);
  }
  return fit;
}

Result<Fit> fit_torsion(const Fit& from, const std::vector<PreparedRecord>& records,
                        const SolverSettings& settings, const IntegratorSettings& integrator) {
  FreeTerms free = from.at.layout.free_terms();
  free.initial = true;
  LinearStart start = with_terms(from.at, free);
  for (std::size_t k = 0; k < records.size(); ++k) {
    start.p[start.layout.initial_group.first + k] = records[k].smooth.motion.position.front();
  }
  TorsionResiduals problem(start.layout, records, integrator);
  if (auto weighed = problem.weigh(start.p); !weighed) return tl::unexpected(weighed.error());
  return minimised(problem, start, records, settings, Direction::torsion);
}

std::vector<ParameterEstimate> parameters_of(const Fit& fit, bool angular) {
  std::vector<ParameterEstimate> list;
  for (std::size_t k = 0; k < fit.solution.p.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    ParameterEstimate one;
    one.name = fit.at.layout.name(k);
    one.unit = fit.at.layout.unit(k, angular);
    one.value = fit.solution.p[k];
    one.bound_active = fit.solution.bound_active[k];
    if (!one.bound_active) {
      one.std = std::sqrt(std::max(0.0, fit.covariance(i, i)));
      one.ci95_lower = one.value - kNormal95 * one.std;
      one.ci95_upper = one.value + kNormal95 * one.std;
    }
    list.push_back(std::move(one));
  }
  return list;
}

// Root mean square of the weighted residuals: 1 where nothing but noise is left.
std::vector<RecordingFit> fits_of(const Fit& fit, const std::vector<PreparedRecord>& records) {
  std::vector<RecordingFit> list;
  Eigen::Index row = 0;
  for (const auto& one : records) {
    const auto height = static_cast<Eigen::Index>(one.rows.size());
    const double norm = fit.linear.residual.segment(row, height).norm();
    list.push_back({one.record.id, Split::train, norm / std::sqrt(static_cast<double>(height))});
    row += height;
  }
  return list;
}

Estimate estimate_of(const Fit& fit, const std::vector<PreparedRecord>& records,
                     const TermDecision& decision) {
  const Ranges ranges = ranges_of(records, fit.at.layout.free_terms().zeros);
  Estimate estimate;
  estimate.estimator = "trajectory_ceres";
  estimate.model = fit.at.layout.model(fit.solution.p);
  estimate.parameters = parameters_of(fit, !records.front().record.linear);
  estimate.termination = fit.solution.termination;
  estimate.cost = fit.solution.cost;
  estimate.residual = fit.direction == Direction::torsion
                          ? "torsion: innovations of eq. (3) integrated from the measured torque, in "
                            "standard deviations of their noise"
                          : "torque: eq. (4) along the measured motion, in standard deviations of "
                            "its noise";
  estimate.fits = fits_of(fit, records);
  estimate.identifiability = {decision.condition, decision.absorbed, decision.verdict,
                              decision.says};
  estimate.bands =
      torsion_bands(fit.at.layout, fit.solution.p, fit.covariance,
                    {ranges.lowest_motion, ranges.highest_motion, ranges.velocity});
  estimate.notes = decision.notes;
  estimate.evaluations = fit.solution.evaluations;
  return estimate;
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
                             .delay = !travels && word(problem, method, "delay") == "auto"};
  const FreeTerms base = base_terms(*records);
  const auto richest = richest_start(*records, base);
  if (!richest) return tl::unexpected(richest.error());
  if (auto added = add_motion_noise(*records, *richest); !added) {
    return tl::unexpected(added.error());
  }
  const auto decision = decide_terms(*richest, *records, base, allowed);
  if (!decision) return tl::unexpected(decision.error());
  const auto start = chosen_start(*records, base, *richest, decision->free);
  if (!start) return tl::unexpected(start.error());

  const SolverSettings settings{
      .max_iterations = static_cast<int>(number(problem, method, "iterations"))};
  auto result = fit_torque_pruned(with_terms(*start, decision->free), *records, settings);
  if (result && direction_of(problem, method, *records) == Direction::torsion) {
    const double tolerance = number(problem, method, "tolerance");
    result = fit_torsion(*result, *records, settings, {tolerance, tolerance, 200000});
  }
  if (!result) return tl::unexpected(result.error());
  Estimate estimate = estimate_of(*result, *records, *decision);
  estimate.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return estimate;
}

}  // namespace

MethodRow describe_trajectory_ceres() {
  return {.id = "trajectory_ceres",
          .summary = "f, g^-1 and h of eq. (3) over whole recordings: CVODES with forward "
                     "sensitivities inside Ceres",
          .source = "Dhaouadi and Ghorbel (2003), eqs. (3), (4); laws of the catalogue",
          .options = {{.name = "simulate",
                       .meaning = "what is simulated and compared: torsion by eq. (3) from the "
                                  "torque, or torque by eq. (4) from the motion; auto: torsion, "
                                  "but torque where an angle or a displacement is imposed",
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
                       .upper = 1e6}},
          .fit = fit};
}

}  // namespace flexspline::estimators
