#include "ode_fit/check.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace flexspline::estimators {
namespace {

Result<void> refuse(std::string problem, std::string remedy) {
  return failure(ErrorCode::bad_data, std::move(problem), std::move(remedy));
}

Result<void> check_parameter(const OdeParameter& p) {
  if (!std::isfinite(p.start)) {
    return refuse(fmt::format("parameter '{}' starts at {}", p.name, p.start), "give it a number");
  }
  if (!(p.lower < p.upper)) {
    return refuse(fmt::format("parameter '{}' has bounds [{}, {}]", p.name, p.lower, p.upper),
                  "the lower bound must lie below the upper one");
  }
  if (p.start < p.lower || p.start > p.upper) {
    return refuse(fmt::format("parameter '{}' starts at {}, outside its bounds [{}, {}]", p.name,
                              p.start, p.lower, p.upper),
                  "start inside the bounds, or widen them");
  }
  if (!(p.scale > 0.0) || !std::isfinite(p.scale)) {
    return refuse(fmt::format("parameter '{}' has scale {}", p.name, p.scale),
                  "a scale is a typical size, above 0");
  }
  return {};
}

Result<void> check_initial(const OdeExperiment& experiment, std::size_t states) {
  if (experiment.initial.size() != states) {
    return refuse(fmt::format("{} initial values for {} states", experiment.initial.size(), states),
                  "give one value or parameter a state");
  }
  for (std::size_t i = 0; i < states; ++i) {
    if (const auto* value = std::get_if<double>(&experiment.initial[i])) {
      if (std::isfinite(*value)) continue;
      return refuse(fmt::format("initial value of state {} is {}", i + 1, *value),
                    "give it a number");
    }
    auto checked = check_parameter(std::get<OdeParameter>(experiment.initial[i]));
    if (!checked) return checked;
  }
  return {};
}

Result<void> check_times(const OdeExperiment& experiment) {
  if (experiment.times.empty()) return refuse("no measurement times", "leave the experiment out");
  double last = experiment.start_time;
  for (std::size_t k = 0; k < experiment.times.size(); ++k) {
    const double t = experiment.times[k];
    if (std::isfinite(t) && (t > last || (k == 0 && t == last))) {
      last = t;
      continue;
    }
    return refuse(fmt::format("time {} of measurement {} does not follow {}", t, k + 1, last),
                  "times increase, and none lies before start_time");
  }
  return {};
}

Result<void> check_sizes(const OdeExperiment& experiment, std::size_t states) {
  const auto& observation = experiment.observation;
  if (observation.size() > 0 && observation.cols() != static_cast<Eigen::Index>(states)) {
    return refuse(
        fmt::format("observation has {} columns for {} states", observation.cols(), states),
        "one column a state");
  }
  if (!observation.allFinite()) return refuse("observation has a NaN", "fill it with numbers");
  const std::size_t outputs =
      observation.size() > 0 ? static_cast<std::size_t>(observation.rows()) : states;
  const std::size_t values = experiment.times.size() * outputs;
  if (experiment.sigma.size() != outputs || experiment.measured.size() != values ||
      (!experiment.mask.empty() && experiment.mask.size() != values)) {
    return refuse(
        fmt::format("{} sigmas, {} measured values and a mask of {} for {} instants of {} outputs",
                    experiment.sigma.size(), experiment.measured.size(), experiment.mask.size(),
                    experiment.times.size(), outputs),
        "one sigma an output; measured and mask are [instant][output]");
  }
  return {};
}

Result<void> check_values(const OdeExperiment& experiment) {
  const std::size_t outputs = experiment.sigma.size();
  for (std::size_t o = 0; o < outputs; ++o) {
    const double sigma = experiment.sigma[o];
    if (sigma > 0.0 && std::isfinite(sigma)) continue;
    return refuse(fmt::format("sigma of output {} is {}", o + 1, sigma), "noise is above 0");
  }
  for (std::size_t k = 0; k < experiment.measured.size(); ++k) {
    const bool counts = experiment.mask.empty() || experiment.mask[k];
    if (!counts || std::isfinite(experiment.measured[k])) continue;
    return refuse(fmt::format("output {} measured at t = {} is {}", k % outputs + 1,
                              experiment.times[k / outputs], experiment.measured[k]),
                  "mask it, or repair the record");
  }
  return {};
}

Result<void> check_experiment(const OdeExperiment& experiment, std::size_t states) {
  auto checked = check_initial(experiment, states);
  if (checked) checked = check_times(experiment);
  if (checked) checked = check_sizes(experiment, states);
  if (checked) checked = check_values(experiment);
  if (checked) return checked;
  return tl::unexpected(
      in_context(std::move(checked).error(), fmt::format("experiment '{}'", experiment.id)));
}

Result<void> check_inequalities(const OdeFitProblem& problem) {
  if (problem.inequalities == nullptr) return {};
  const auto& all = *problem.inequalities;
  std::vector<double> p;
  for (const auto& parameter : problem.parameters) p.push_back(parameter.start);
  std::vector<double> g(all.count());
  all.values(p, g);
  for (std::size_t i = 0; i < g.size(); ++i) {
    if (!(all.lower(i) < all.upper(i))) {
      return refuse(fmt::format("inequality '{}' has bounds [{}, {}]", all.name(i), all.lower(i),
                                all.upper(i)),
                    "the lower bound must lie below the upper one");
    }
    if (!std::isfinite(g[i])) {
      return refuse(fmt::format("inequality '{}' is {} at the start", all.name(i), g[i]),
                    "start where it can be computed");
    }
  }
  return {};
}

Result<void> misuse(std::string problem, std::string remedy) {
  return failure(ErrorCode::usage, std::move(problem), std::move(remedy));
}

}  // namespace

Result<void> check(const OdeFitSettings& settings) {
  if (!(settings.loss_scale > 0.0) || !std::isfinite(settings.loss_scale)) {
    return misuse(fmt::format("loss_scale is {}", settings.loss_scale),
                  "give standard deviations of the noise, above 0");
  }
  if (settings.weighting == Weighting::coloured && settings.loss != Loss::squared) {
    return misuse(fmt::format("coloured noise with the {} loss: an outlier would spread over the "
                              "innovations after it, and the loss would meet it there",
                              name_of(settings.loss)),
                  "mask the outliers, or weigh each output by its own noise");
  }
  const bool drawn = settings.uncertainty.kind == Uncertainty::bootstrap_parametric ||
                     settings.uncertainty.kind == Uncertainty::bootstrap_block;
  if (drawn && settings.uncertainty.replicates < 20) {
    return misuse(fmt::format("{} replicates of the bootstrap", settings.uncertainty.replicates),
                  "percentiles of 95 % need at least 20, better 200");
  }
  if (settings.uncertainty.kind == Uncertainty::bootstrap_parametric &&
      settings.loss != Loss::squared) {
    return misuse("normal noise for the replicates of a fit that does not believe in it",
                  "take bootstrap_block, or the squared loss");
  }
  return {};
}

Result<void> check(const OdeFitProblem& problem) {
  if (problem.system == nullptr) return refuse("the problem has no system", "give it one");
  const std::size_t states = problem.system->states();
  if (problem.parameters.size() != problem.system->parameters()) {
    return refuse(fmt::format("{} parameters described for a system of {}",
                              problem.parameters.size(), problem.system->parameters()),
                  "describe every parameter once, in the system's order");
  }
  if (!problem.state_scale.empty() && (problem.state_scale.size() != states ||
                                       !std::ranges::all_of(problem.state_scale, [](double s) {
                                         return s > 0.0 && std::isfinite(s);
                                       }))) {
    return refuse("state_scale does not give each state a size above 0",
                  "give one a state, or none");
  }
  for (const auto& parameter : problem.parameters) {
    auto checked = check_parameter(parameter);
    if (!checked) return checked;
  }
  if (problem.experiments.empty()) return refuse("the problem has no experiment", "give it one");
  for (const auto& experiment : problem.experiments) {
    auto checked = check_experiment(experiment, states);
    if (!checked) return checked;
  }
  return check_inequalities(problem);
}

}  // namespace flexspline::estimators
