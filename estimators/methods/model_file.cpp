#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Dense>

#include "flexspline/core/effect.hpp"
#include "flexspline/core/effect_dependence.hpp"
#include "flexspline/core/law.hpp"
#include "flexspline/estimators/method.hpp"
#include "given_model/given_residuals.hpp"
#include "given_model/given_start.hpp"
#include "ode_fit/verdict.hpp"
#include "uncertainty/bands.hpp"
#include "uncertainty/covariance.hpp"
#include "uncertainty/estimate_parts.hpp"

namespace flexspline::estimators {

MethodRow describe_model_file();

namespace {

/// An effect that looks at the torque makes every other number non-linear.
bool follows_torque(const EffectSpec& spec) {
  const auto row = find_effect(spec.effect);
  if (!row) return false;
  const auto values = parameter_values(**row, spec);
  return values && depends_on(**row, *values, &Instant<Complex>::transmitted_torque);
}

/// The start of all unknowns: first without the effects that follow the torque.
Result<std::vector<double>> start_of(const GivenModel& given,
                                     const std::vector<GivenParameter>& parameters,
                                     const std::vector<GivenRecord>& records, bool each_zero,
                                     const GivenResiduals& whole, int steps) {
  ModelSpec reduced = given.model;
  std::vector<bool> kept(parameters.size(), true);
  std::size_t k = parameters.size();
  for (const EffectSpec& spec : given.model.effects) k -= spec.parameters.size();
  reduced.effects.clear();
  for (const EffectSpec& spec : given.model.effects) {
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

Identifiability judge(const GivenResiduals& problem, const LeastSquaresSolution& solution,
                      const Linearisation& linear, double noise) {
  OdeLayout names;
  std::vector<Eigen::Index> loose;
  for (std::size_t k = 0; k < solution.p.size(); ++k) {
    names.unknowns.push_back({.name = problem.unknowns()[k].name});
    if (!solution.bound_active[k]) loose.push_back(static_cast<Eigen::Index>(k));
  }
  const auto n = static_cast<Eigen::Index>(solution.p.size());
  const Eigen::MatrixXd free = Eigen::MatrixXd::Identity(n, n)(Eigen::all, loose);
  return verdict(names, solution.p, free, linear.jacobian, noise, false);
}

struct Reach {
  double motion = 0.0;
  double rate = 0.0;
};

Reach reach_of(const std::vector<GivenRecord>& records) {
  Reach reach;
  for (const GivenRecord& one : records) {
    for (std::size_t i : one.rows) {
      reach.motion = std::max(reach.motion, std::abs(one.motion.position[i]));
      reach.rate = std::max(reach.rate, std::abs(one.motion.velocity[i]));
    }
  }
  return reach;
}

/// Bands of the laws that have free coefficients.
std::vector<FunctionBand> bands_of(const ModelSpec& model, const GivenResiduals& problem,
                                   const Eigen::MatrixXd& covariance, const Reach& reach) {
  std::vector<FunctionBand> bands;
  const std::pair<const char*, std::pair<const LawSpec*, double>> laws[] = {
      {"f", {&model.f, reach.motion}},
      {"g_inverse", {&model.g_inverse, reach.rate}},
      {"h", {&model.h, reach.motion}}};
  for (const auto& [name, law] : laws) {
    const auto size = static_cast<Eigen::Index>(law.first->coefficients.size());
    Eigen::MatrixXd own = Eigen::MatrixXd::Zero(size, size);
    std::vector<Eigen::Index> at(static_cast<std::size_t>(size), -1);
    for (std::size_t k = 0; k < problem.of_model(); ++k) {
      for (Eigen::Index c = 0; c < size; ++c) {
        if (problem.unknowns()[k].name == fmt::format("{}[{}]", name, c))
          at[static_cast<std::size_t>(c)] = static_cast<Eigen::Index>(k);
      }
    }
    if (std::ranges::none_of(at, [](auto k) { return k >= 0; })) continue;
    for (Eigen::Index a = 0; a < size; ++a) {
      for (Eigen::Index b = 0; b < size; ++b) {
        const auto i = at[static_cast<std::size_t>(a)], j = at[static_cast<std::size_t>(b)];
        if (i >= 0 && j >= 0) own(a, b) = covariance(i, j);
      }
    }
    const auto made = make_law(*law.first);
    if (!made) continue;
    bands.push_back(law_band(name, **made, own, -law.second, law.second));
  }
  return bands;
}

Estimate estimate_of(const GivenResiduals& problem, const LeastSquaresSolution& solution,
                     const Linearisation& linear, const std::vector<GivenRecord>& records) {
  const auto rows = static_cast<double>(linear.residual.size());
  const auto loose = std::ranges::count(solution.bound_active, false);
  const double variance =
      linear.residual.squaredNorm() / std::max(1.0, rows - static_cast<double>(loose));
  const Eigen::MatrixXd covariance =
      sandwich(linear.jacobian, score_covariance(problem, linear), solution.bound_active);
  Estimate estimate;
  estimate.estimator = "model_file";
  estimate.model = problem.model_at(solution.p);
  const Reach reach = reach_of(records);
  estimate.model.f.valid_to = reach.motion;
  estimate.model.g_inverse.valid_to = reach.rate;
  for (std::size_t k = 0; k < solution.p.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    const GivenParameter& one = problem.unknowns()[k];
    estimate.parameters.push_back(parameter_estimate(one.name, one.unit, solution.p[k],
                                                     covariance(i, i), solution.bound_active[k]));
  }
  estimate.termination = solution.termination;
  estimate.cost = solution.cost;
  estimate.residual = fmt::format("{} along the measured motion, {}",
                                  records.front().record.linear ? "force" : "torque",
                                  records.front().record.linear ? "N" : "Nm");
  Eigen::Index row = 0;
  for (const GivenRecord& one : records) {
    const auto height = static_cast<Eigen::Index>(one.rows.size());
    estimate.fits.push_back(
        {one.record.id, Split::train,
         linear.residual.segment(row, height).norm() / std::sqrt(static_cast<double>(height))});
    row += height;
  }
  estimate.identifiability = judge(problem, solution, linear, std::sqrt(variance));
  estimate.bands = bands_of(estimate.model, problem, covariance, reach);
  estimate.evaluations = solution.evaluations;
  return estimate;
}

double rms_effort(const std::vector<GivenRecord>& records) {
  double sum = 0.0;
  double count = 0.0;
  for (const GivenRecord& one : records) {
    for (std::size_t i : one.rows) sum += one.record.effort[i] * one.record.effort[i];
    count += static_cast<double>(one.rows.size());
  }
  return std::sqrt(sum / std::max(1.0, count));
}

Result<Estimate> fit(const FitProblem& problem) {
  const auto started = std::chrono::steady_clock::now();
  const MethodRow method = describe_model_file();
  if (problem.records.empty()) {
    return failure(ErrorCode::bad_data, "there is no recording to train on",
                   "mark one with split = \"train\"");
  }
  if (!problem.model) {
    return failure(ErrorCode::usage, "model_file has no model to fit",
                   "give one: fit DATASET --model MODEL.toml, or model = \"…\" in a study");
  }
  const auto parameters = given_parameters(*problem.model);
  if (!parameters) return tl::unexpected(parameters.error());
  const auto records =
      given_records(problem.records, static_cast<std::size_t>(number(problem, method, "samples")),
                    static_cast<std::size_t>(number(problem, method, "path")));
  if (!records) return tl::unexpected(records.error());
  const bool each_zero = word(problem, method, "zero") == "each";
  GivenResiduals residuals(problem.model->model, *parameters, *records, each_zero);
  const auto start = start_of(*problem.model, *parameters, *records, each_zero, residuals,
                              static_cast<int>(number(problem, method, "start_steps")));
  if (!start) return tl::unexpected(start.error());
  const auto at_start = linearise(residuals, *start);
  if (!at_start) return tl::unexpected(at_start.error());
  const auto unknowns = bounded(residuals, *start, *at_start, rms_effort(*records));
  std::vector<double> sizes;
  for (const auto& one : unknowns) sizes.push_back(1e-2 * one.scale);
  residuals.set_sizes(sizes);
  const auto solution =
      minimise(residuals, unknowns,
               {.max_iterations = static_cast<int>(number(problem, method, "iterations")),
                .function_tolerance = 1e-9});
  if (!solution) return tl::unexpected(solution.error());
  const auto linear = linearise(residuals, solution->p);
  if (!linear) return tl::unexpected(linear.error());
  Estimate estimate = estimate_of(residuals, *solution, *linear, *records);
  estimate.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return estimate;
}

}  // namespace

MethodRow describe_model_file() {
  return {.id = "model_file",
          .summary =
              "the laws and effects of a model file, all its numbers, by the torque along the "
              "measured motion: separable least squares to start with, then Ceres within bounds",
          .source = "Golub and Pereyra (1973); Dhaouadi and Ghorbel (2003), eq. (4)",
          .options = {{.name = "zero",
                       .meaning = "where the motion has its zero: as recorded, or fitted for each "
                                  "recording (a held-out one gets its own)",
                       .choices = {"recorded", "each"}},
                      {.name = "start_steps",
                       .meaning = "most steps of the shapes before all numbers are fitted together",
                       .value = 15,
                       .lower = 0,
                       .upper = 1000},
                      {.name = "iterations",
                       .meaning = "most iterations of the solver",
                       .value = 100,
                       .lower = 1,
                       .upper = 10000},
                      {.name = "samples",
                       .meaning = "most residuals of one recording; longer ones are thinned evenly",
                       .value = 3000,
                       .lower = 100,
                       .upper = 1e6},
                      {.name = "path",
                       .meaning = "most samples of one recording that are simulated; fewer are "
                                  "faster where effects follow the torque",
                       .value = 20000,
                       .lower = 100,
                       .upper = 1e7}},
          .fit = fit,
          .takes_model = true};
}

}  // namespace flexspline::estimators
