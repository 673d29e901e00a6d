#pragma once

#include <cmath>
#include <memory>

#include "flexspline/core/twice_ode_system.hpp"
#include "flexspline/estimators/ode_fit.hpp"

namespace flexspline::estimators {

/// y' = -k y: y = y(0) exp(-k t).
class Decay final : public OdeLaw<Decay> {
 public:
  std::size_t states() const override { return 1; }
  std::size_t parameters() const override { return 1; }
  template <class S>
  void law(double, std::span<const S> y, std::span<const S> p, std::span<S> ydot) const {
    ydot[0] = S(-S(p[0] * y[0]));
  }
};

/// Exact values of 2 exp(-0.7 t) at five instants after the start, disturbed by `noise` with
/// alternating sign; y(0) is free.
inline OdeFitProblem decay(double noise = 0.0) {
  OdeFitProblem problem{
      .system = std::make_shared<Decay>(), .parameters = {}, .experiments = {}, .state_scale = {}};
  OdeParameter rate{.name = "k", .start = 0.2};
  rate.lower = 0.0;
  problem.parameters = {rate};
  OdeExperiment experiment{.id = "first"};
  experiment.initial = {OdeParameter{.name = "y(0)", .start = 1.0}};
  for (int k = 1; k <= 5; ++k) {
    experiment.times.push_back(0.5 * k);
    experiment.measured.push_back(2.0 * std::exp(-0.35 * k) + (k % 2 == 0 ? noise : -noise));
  }
  experiment.sigma = {0.01};
  problem.experiments = {experiment};
  return problem;
}

inline constexpr OdeFitMethod kOdeFitMethods[] = {
    OdeFitMethod::single_shooting, OdeFitMethod::multiple_shooting, OdeFitMethod::collocation};

}  // namespace flexspline::estimators
