#include <chrono>

#include "flexspline/estimators/method.hpp"
#include "given_model/given_estimate.hpp"
#include "given_model/given_search.hpp"
#include "given_model/held_fit.hpp"

namespace flexspline::estimators {

MethodRow describe_model_file();

namespace {

GivenSearchSettings settings_of(const FitProblem& problem) {
  const MethodRow method = describe_model_file();
  const auto whole = [&](const char* name) {
    return static_cast<int>(number(problem, method, name));
  };
  return {.each_zero = word(problem, method, "zero") == "each",
          .start_steps = whole("start_steps"),
          .iterations = whole("iterations"),
          .starts = whole("starts"),
          .first_start = whole("first_start"),
          .seed = static_cast<std::uint64_t>(whole("seed"))};
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
  const auto records = given_records(
      problem.records, static_cast<std::size_t>(number(problem, method, "samples")),
      static_cast<std::size_t>(number(problem, method, "path")),
      word(problem, method, "weight") == "relative" ? ErrorWeight::relative : ErrorWeight::even);
  if (!records) return tl::unexpected(records.error());
  const auto found =
      search_given(problem.model->model, *parameters, *records, settings_of(problem));
  if (!found) return tl::unexpected(found.error());
  const auto linear = linearise(found->residuals, found->solution.p);
  if (!linear) return tl::unexpected(linear.error());
  Estimate estimate = given_estimate(found->residuals, found->solution, *linear, *records);
  if (!found->says.empty()) estimate.notes.push_back(found->says);
  if (const double held = number(problem, method, "profile_parameter"); held > 0.0) {
    auto away =
        held_fit(*problem.model, estimate, *records, settings_of(problem),
                 {static_cast<std::size_t>(held) - 1, number(problem, method, "profile_distance")});
    if (!away) return away;
    estimate = *std::move(away);
  }
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
          .options =
              {{.name = "zero",
                .meaning = "where the motion has its zero: as recorded, or fitted for each "
                           "recording (a held-out one gets its own)",
                .choices = {"recorded", "each"}},
               {.name = "weight",
                .meaning = "how much an error counts: the same everywhere, or relative to the "
                           "torque measured there (a tenth of its root mean square at least), so "
                           "that small torques are followed as closely as large ones",
                .choices = {"even", "relative"}},
               {.name = "start_steps",
                .meaning = "most steps of the shapes before all numbers are fitted together; "
                           "0 leaves out the second start that they give",
                .value = 15,
                .lower = 0,
                .upper = 1000},
               {.name = "starts",
                .meaning = "fits from as many starts, the model's and others drawn within a "
                           "factor of 4 about it; the best is taken, and counts as converged "
                           "where two end there",
                .value = 1,
                .lower = 1,
                .upper = 1000},
               {.name = "first_start",
                .meaning = "number of the first of them: 0 the model's own numbers, others drawn",
                .value = 0,
                .lower = 0,
                .upper = 1e6},
               {.name = "seed", .meaning = "of those starts", .value = 1, .lower = 0, .upper = 1e9},
               {.name = "profile_parameter",
                .meaning = "number, from 1, of the fitted parameter that is then held away from "
                           "its estimate while all others are fitted again; 0: none",
                .value = 0,
                .lower = 0,
                .upper = 1e6},
               {.name = "profile_distance",
                .meaning = "how far away, in its standard deviations",
                .value = 0,
                .lower = -1e3,
                .upper = 1e3},
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
