#pragma once

#include <span>
#include <vector>

#include "flexspline/core/rig.hpp"
#include "flexspline/core/simulate.hpp"

namespace flexspline {

/// simulate_torque as a function of time, between the motion's first and last instant: the motion
/// by the quintic through phi, phi' and phi'' of both neighbours, its turning points found, so that
/// every piece is monotone and stop operators are exact at any instant; memories that know the
/// clock are integrated along the curve, to 1e-11. Sampled torque instead rounds the corners where
/// elements begin to slip, by the interval squared.
/// Errors: those of a force-driven specimen; kinematics that follow the torque; numerics where a
/// memory switches while it slips (gms_friction).
Result<Signal> torque_signal(const ModelSpec& model, const Motion& motion);

/// simulate_torsion with the torque as a function of time.
Result<std::vector<double>> simulate_torsion(const ModelSpec& model, std::span<const double> time,
                                             const Signal& torque, double initial,
                                             const IntegratorSettings& settings = {});

}  // namespace flexspline
