#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <set>

#include "flexspline/core/effect.hpp"
#include "flexspline/core/effect_dependence.hpp"
#include "flexspline/estimators/method.hpp"
#include "given_model/given_estimate.hpp"
#include "given_model/given_start.hpp"

namespace flexspline::estimators {

MethodRow describe_model_file();

namespace {

constexpr double kStepOfScale = 1e-2;  // of a scale: the size that differences of an unknown near
                                       // zero are taken by

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

double rms_effort(const std::vector<GivenRecord>& records) {
  double sum = 0.0;
  double count = 0.0;
  for (const GivenRecord& one : records) {
    for (std::size_t i : one.rows) sum += one.record.effort[i] * one.record.effort[i];
    count += static_cast<double>(one.rows.size());
  }
  return std::sqrt(sum / std::max(1.0, count));
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

/// From where the search of the shapes leads, and from the shapes given: that search can end in
/// another valley. Of the solutions the one of lowest cost.
Result<LeastSquaresSolution> best_of(const FitProblem& problem, const MethodRow& method,
                                     const std::vector<GivenParameter>& parameters,
                                     const std::vector<GivenRecord>& records, bool each_zero,
                                     GivenResiduals& residuals) {
  const auto steps = static_cast<int>(number(problem, method, "start_steps"));
  const auto iterations = static_cast<int>(number(problem, method, "iterations"));
  std::optional<LeastSquaresSolution> best;
  for (const int most : std::set{0, steps}) {
    const auto start = start_of(*problem.model, parameters, records, each_zero, residuals, most);
    if (!start) return tl::unexpected(start.error());
    auto solution = solved(residuals, *start, rms_effort(records), iterations);
    if (!solution) return solution;
    if (!best || solution->cost < best->cost) best = std::move(*solution);
  }
  return *best;
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
  const auto solution = best_of(problem, method, *parameters, *records, each_zero, residuals);
  if (!solution) return tl::unexpected(solution.error());
  const auto linear = linearise(residuals, solution->p);
  if (!linear) return tl::unexpected(linear.error());
  Estimate estimate = given_estimate(residuals, *solution, *linear, *records);
  estimate.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return estimate;
}

}  // namespace

MethodRow describe_model_file() {
  return {
      .id = "model_file",
      .summary =
          "the laws and effects of a model file, all its numbers, by the torque along the "
          "measured motion: separable least squares to start with, then Ceres within bounds",
      .source = "Golub and Pereyra (1973); Dhaouadi and Ghorbel (2003), eq. (4)",
      .options = {{.name = "zero",
                   .meaning = "where the motion has its zero: as recorded, or fitted for each "
                              "recording (a held-out one gets its own)",
                   .choices = {"recorded", "each"}},
                  {.name = "start_steps",
                   .meaning = "most steps of the shapes before all numbers are fitted together; "
                              "0 leaves out the second start that they give",
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
