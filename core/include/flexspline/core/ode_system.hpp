#pragma once

#include <span>
#include <vector>

#include "flexspline/core/error.hpp"
#include "flexspline/core/scalar.hpp"
#include "flexspline/core/simulate.hpp"

namespace flexspline {

/// An initial value problem y' = F(t, y; p). The law is written once as a template over the scalar
/// and offered for plain numbers and for duals, from which Jacobians and sensitivities come.
class OdeSystem {
 public:
  virtual ~OdeSystem() = default;

  virtual std::size_t states() const = 0;
  virtual std::size_t parameters() const = 0;
  virtual void rate(double t, std::span<const double> y, std::span<const double> p,
                    std::span<double> ydot) const = 0;
  virtual void rate(double t, std::span<const Dual> y, std::span<const Dual> p,
                    std::span<Dual> ydot) const = 0;
};

/// bdf for stiff systems, with Newton's iteration; adams for others, with fixed-point iteration.
enum class Stepping { bdf, adams };

/// The tolerances hold for each step, so a trajectory errs by some hundred to a
/// thousand times as much (six periods of an oscillation). Derivatives
/// in p are held to the tolerance of the state over |p|.
struct SystemSettings {
  Stepping stepping = Stepping::bdf;
  double relative_tolerance = 1e-8;
  std::vector<double>
      absolute_tolerance;   ///< one a state, positive; empty: relative_tolerance for each
  long max_steps = 200000;  ///< from the first instant to the last
};

/// States at the instants asked for, [instant][state], and how hard it was.
struct SystemTrajectory {
  std::size_t states = 0;
  std::vector<double> state;
  std::vector<double> sensitivity;  ///< [instant][state][parameter]; empty where not asked for
  long steps = 0;
  long evaluations = 0;
};

/// Integrates by CVODES from y(times[0]) = initial, with the Jacobian by duals.
/// Errors: numerics, with the time and the states reached and what CVODES says.
Result<SystemTrajectory> integrate_system(const OdeSystem& system, std::span<const double> p,
                                          std::span<const double> times,
                                          std::span<const double> initial,
                                          const SystemSettings& settings);

/// The same with forward sensitivities dy/dp under error control; initial_sensitivity is
/// [state][parameter], empty for zero. An evaluation costs one of the duals for every 32
/// parameters.
Result<SystemTrajectory> integrate_with_sensitivities(const OdeSystem& system,
                                                      std::span<const double> p,
                                                      std::span<const double> times,
                                                      std::span<const double> initial,
                                                      std::span<const double> initial_sensitivity,
                                                      const SystemSettings& settings);

/// Gradient in p of sum_k sum_i weight[k][i] y_i(times[k]) by CVODES' adjoint mode: for many
/// parameters and few outputs. The adjoint starts anew at each instant with a weight, some ten to
/// twenty steps each; instants without one cost nothing.
/// Errors: numerics, with the time and the states (in "adjoint", its states) reached.
Result<std::vector<double>> adjoint_gradient(const OdeSystem& system, std::span<const double> p,
                                             std::span<const double> times,
                                             std::span<const double> initial,
                                             std::span<const double> initial_sensitivity,
                                             std::span<const double> weight,
                                             const SystemSettings& settings);

}  // namespace flexspline
