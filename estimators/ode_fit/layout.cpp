#include "ode_fit/layout.hpp"

#include <algorithm>
#include <cmath>

namespace flexspline::estimators {
namespace {

Eigen::Index index(std::size_t k) { return static_cast<Eigen::Index>(k); }

// Size of a state: of its initial value and of the outputs that show it and nothing else.
double seen_size(const OdeLayout& layout, std::size_t state) {
  double size = 0.0;
  for (const auto& experiment : layout.experiments) {
    const auto& initial = experiment.initial[state];
    size = std::max(
        size, std::abs(initial.known() ? initial.value : layout.unknowns[initial.unknown].start));
    for (std::size_t o = 0; o < experiment.outputs(); ++o) {
      const auto row = experiment.source.observation.row(index(o));
      const double gain = std::abs(row[index(state)]);
      if (gain == 0.0 || row.cwiseAbs().sum() != gain) continue;
      for (std::size_t k = 0; k < experiment.source.times.size(); ++k) {
        if (!experiment.counts(k, o)) continue;
        const double value = experiment.source.measured[k * experiment.outputs() + o];
        size = std::max(size, std::abs(value) / gain);
      }
    }
  }
  return size > 0.0 ? size : 1.0;
}

LaidOutExperiment lay_out(const OdeExperiment& experiment, std::size_t states,
                          std::vector<OdeParameter>& unknowns) {
  LaidOutExperiment result{experiment, {}};
  if (experiment.observation.size() == 0) {
    result.source.observation = Eigen::MatrixXd::Identity(index(states), index(states));
  }
  for (const auto& initial : experiment.initial) {
    if (const auto* value = std::get_if<double>(&initial)) {
      result.initial.push_back({Source::kKnown, *value});
      continue;
    }
    result.initial.push_back({unknowns.size(), 0.0});
    unknowns.push_back(std::get<OdeParameter>(initial));
  }
  return result;
}

}  // namespace

bool LaidOutExperiment::counts(std::size_t instant, std::size_t output) const {
  return source.mask.empty() || source.mask[instant * outputs() + output];
}

std::size_t LaidOutExperiment::residuals(std::size_t first_instant,
                                         std::size_t last_instant) const {
  if (source.mask.empty()) return (last_instant - first_instant) * outputs();
  const auto from = source.mask.begin() + static_cast<std::ptrdiff_t>(first_instant * outputs());
  const auto to = source.mask.begin() + static_cast<std::ptrdiff_t>(last_instant * outputs());
  return static_cast<std::size_t>(std::count(from, to, true));
}

double LaidOutExperiment::residual(std::size_t instant, std::size_t output,
                                   std::span<const double> y) const {
  double value = -source.measured[instant * outputs() + output];
  for (std::size_t i = 0; i < y.size(); ++i) {
    value += source.observation(index(output), index(i)) * y[i];
  }
  return value / source.sigma[output];
}

double LaidOutExperiment::slope(std::size_t output, std::size_t state) const {
  return source.observation(index(output), index(state)) / source.sigma[output];
}

std::vector<double> OdeLayout::start() const {
  std::vector<double> q;
  for (const auto& unknown : unknowns) q.push_back(unknown.start);
  return q;
}

SystemSettings OdeLayout::integration(double tolerance) const {
  SystemSettings settings;
  settings.relative_tolerance = tolerance;
  for (const double scale : state_scale) settings.absolute_tolerance.push_back(tolerance * scale);
  if (most_steps > 0) settings.max_steps = most_steps;
  return settings;
}

OdeLayout lay_out(const OdeFitProblem& problem, const OdeFitSettings& settings) {
  OdeLayout layout{problem.system,      problem.parameters,   {},
                   problem.state_scale, problem.inequalities, {settings.loss, settings.loss_scale},
                   settings.most_steps};
  for (const auto& experiment : problem.experiments) {
    layout.experiments.push_back(lay_out(experiment, layout.states(), layout.unknowns));
  }
  if (layout.state_scale.empty()) {
    for (std::size_t i = 0; i < layout.states(); ++i) {
      layout.state_scale.push_back(seen_size(layout, i));
    }
  }
  return layout;
}

double cost_of_nothing(const OdeLayout& layout) {
  const std::vector<double> zero(layout.states(), 0.0);
  double sum = 0.0;
  for (const auto& experiment : layout.experiments) {
    for (std::size_t k = 0; k < experiment.source.times.size(); ++k) {
      for (std::size_t o = 0; o < experiment.outputs(); ++o) {
        if (!experiment.counts(k, o)) continue;
        sum += std::pow(experiment.residual(k, o, zero), 2);
      }
    }
  }
  return 0.5 * sum;
}

}  // namespace flexspline::estimators
