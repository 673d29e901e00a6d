#pragma once

#include <span>
#include <vector>

#include "flexspline/core/error.hpp"
#include "flexspline/core/simulate.hpp"

namespace flexspline {

/// A scalar initial value problem y' = F(t, y, p) with its derivatives.
class ScalarOde {
 public:
  virtual ~ScalarOde() = default;

  /// Number of parameters p whose sensitivities dy/dp are wanted; may be 0.
  virtual std::size_t parameters() const = 0;
  virtual double rate(double t, double y) const = 0;
  /// dF/dy.
  virtual double jacobian(double t, double y) const = 0;
  /// dF/dp, one entry a parameter; returns dF/dy.
  virtual double parameter_derivative(double t, double y, std::span<double> out) const = 0;
};

/// y and dy/dp at the instants asked for; sensitivities row by row: [instant][parameter].
struct SensitiveTrajectory {
  std::vector<double> state;
  std::vector<double> sensitivity;
};

/// Integrates y and dy/dp as one system by CVODES: BDF, modified Newton, both under error control,
/// from y(times[0]) = initial with dy/dp = initial_sensitivity there.
/// Errors: numerics, with the time and state reached and what CVODES says.
Result<SensitiveTrajectory> integrate(const ScalarOde& ode, std::span<const double> times,
                                      double initial, std::span<const double> initial_sensitivity,
                                      const IntegratorSettings& settings);

}  // namespace flexspline
