#pragma once

#include <span>
#include <vector>

#include "flexspline/core/effect.hpp"
#include "flexspline/core/error.hpp"
#include "flexspline/core/model_spec.hpp"

namespace flexspline {

/// Displacement-driven: tau(t) = f(phi) + g^-1(phi'/h(phi)) + effects, eq. (4), at the motion's
/// instants. tau in Nm (N).
/// Errors: a law or effect that cannot be made; numerics where kinematics leave no torque.
Result<std::vector<double>> simulate_torque(const ModelSpec& model, const Motion& motion);

/// How well a torque-driven simulation is to be integrated.
struct IntegratorSettings {
  double relative_tolerance = 1e-8;
  double absolute_tolerance = 1e-8;  ///< in units of the range of f
  long max_steps = 200000;
};

/// Torque-driven: phi' = h(phi) g(tau - f(phi)), eq. (3), from phi(time[0]) = initial, by CVODES
/// (BDF), with tau a spline through its samples. Gives phi at the instants of time, rad (m).
/// Effects: those of the specimen rig, their memory integrated along from unloaded; initial is then
/// the motion at which every memory is empty.
/// Errors: numerics, with the time and the state reached; an effect that needs what eq. (3) does
/// not know beforehand, as inertia_torque the acceleration or sensor_delay the whole signal.
Result<std::vector<double>> simulate_torsion(const ModelSpec& model, std::span<const double> time,
                                             std::span<const double> torque, double initial,
                                             const IntegratorSettings& settings = {});

}  // namespace flexspline
