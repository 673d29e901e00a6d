#pragma once

#include <span>
#include <vector>

#include "flexspline/estimators/ode_fit.hpp"
#include "ode_fit/loss.hpp"
#include "uncertainty/coloured_noise.hpp"

namespace flexspline::estimators {

/// Where a starting value comes from: an unknown of the fit, or a number that is known.
struct Source {
  static constexpr std::size_t kKnown = static_cast<std::size_t>(-1);
  std::size_t unknown = kKnown;
  double value = 0.0;

  bool known() const { return unknown == kKnown; }
  double at(std::span<const double> q) const { return known() ? value : q[unknown]; }
};

/// An experiment with its defaults filled in.
struct LaidOutExperiment {
  OdeExperiment source;
  std::vector<Source> initial;
  std::vector<WhiteningFilter> whitening{};  ///< one an output over what counts of it; or empty

  std::size_t outputs() const { return source.sigma.size(); }
  double start_time() const { return source.start_time; }
  bool measured_at_start() const { return source.times.front() == source.start_time; }
  bool counts(std::size_t instant, std::size_t output) const;
  std::size_t residuals(std::size_t first_instant, std::size_t last_instant) const;
  /// (observation y - measured) / sigma.
  double residual(std::size_t instant, std::size_t output, std::span<const double> y) const;
  /// d residual / d y.
  double slope(std::size_t output, std::size_t state) const;
};

/// The unknowns q of a fit (parameters of the system, then free initial values) and where each is
/// used.
struct OdeLayout {
  std::shared_ptr<const OdeSystem> system;
  std::vector<OdeParameter> unknowns;
  std::vector<LaidOutExperiment> experiments;
  std::vector<double> state_scale;
  std::shared_ptr<const OdeInequalities> inequalities{};
  RobustLoss loss{};
  long most_steps = 0;

  std::size_t states() const { return system->states(); }
  std::vector<double> start() const;
  SystemSettings integration(double tolerance) const;
};

OdeLayout lay_out(const OdeFitProblem& problem, const OdeFitSettings& settings = {});

/// What a method found.
struct OdeSolution {
  std::vector<double> q;
  double cost = kNotComputed;
  Termination termination = Termination::not_run;
  int iterations = 0;
  long evaluations = 0;
  double gap = 0.0;
  std::size_t elements = 0;
  std::vector<std::string> notes{};
  Eigen::MatrixXd active_gradients{};  ///< of active inequalities by q, a row each
  std::vector<std::string> active_inequalities{};
};

/// Half the sum of squared residuals of the measurements alone, at zero model: what the cost is
/// compared with.
double cost_of_nothing(const OdeLayout& layout);

}  // namespace flexspline::estimators
