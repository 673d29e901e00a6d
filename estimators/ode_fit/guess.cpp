#include "ode_fit/guess.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace flexspline::estimators {
namespace {

struct Knots {
  std::vector<double> time;
  std::vector<double> value;

  double at(double t) const {
    const auto next = std::ranges::upper_bound(time, t);
    if (next == time.begin()) return value.front();
    if (next == time.end()) return value.back();
    const auto k = static_cast<std::size_t>(next - time.begin());
    const double part = (t - time[k - 1]) / (time[k] - time[k - 1]);
    return value[k - 1] + part * (value[k] - value[k - 1]);
  }
};

Knots knots_of(const LaidOutExperiment& experiment, std::size_t state, std::size_t output,
               double initial) {
  Knots knots;
  if (!experiment.measured_at_start()) {
    knots.time.push_back(experiment.start_time());
    knots.value.push_back(initial);
  }
  const double gain = experiment.source.observation(static_cast<Eigen::Index>(output),
                                                    static_cast<Eigen::Index>(state));
  for (std::size_t k = 0; k < experiment.source.times.size(); ++k) {
    if (!experiment.counts(k, output)) continue;
    knots.time.push_back(experiment.source.times[k]);
    knots.value.push_back(experiment.source.measured[k * experiment.outputs() + output] / gain);
  }
  return knots;
}

std::vector<double> simulated(const OdeLayout& layout, std::span<const double> initial,
                              std::span<const double> times, double tolerance) {
  const auto q = layout.start();
  const auto run = integrate_system(*layout.system, std::span(q).first(layout.system->parameters()),
                                    times, initial, layout.integration(tolerance));
  if (run) return run->state;
  std::vector<double> states;
  for (std::size_t k = 0; k < times.size(); ++k) {
    states.insert(states.end(), initial.begin(), initial.end());
  }
  return states;
}

}  // namespace

std::optional<std::size_t> output_that_shows(const LaidOutExperiment& experiment,
                                             std::size_t state) {
  for (std::size_t o = 0; o < experiment.outputs(); ++o) {
    const auto row = experiment.source.observation.row(static_cast<Eigen::Index>(o));
    const double gain = std::abs(row[static_cast<Eigen::Index>(state)]);
    if (gain > 0.0 && row.cwiseAbs().sum() == gain) return o;
  }
  return std::nullopt;
}

std::vector<double> guess_states(const OdeLayout& layout, const LaidOutExperiment& experiment,
                                 std::span<const double> times, double tolerance) {
  const auto q = layout.start();
  std::vector<double> initial;
  for (const auto& source : experiment.initial) initial.push_back(source.at(q));
  std::vector<double> states = simulated(layout, initial, times, tolerance);
  const std::size_t count = layout.states();
  for (std::size_t i = 0; i < count; ++i) {
    const auto output = output_that_shows(experiment, i);
    if (!output) continue;
    const Knots knots = knots_of(experiment, i, *output, initial[i]);
    if (knots.time.size() < 2) continue;
    for (std::size_t k = 0; k < times.size(); ++k) states[k * count + i] = knots.at(times[k]);
  }
  return states;
}

}  // namespace flexspline::estimators
