#pragma once

#include <span>
#include <vector>

#include "flexspline/core/effect.hpp"

namespace flexspline {

/// A specimen's path: the motion is motor, load and torsion at once (ratio 1); torques are zero.
std::vector<Instant<double>> instants_of(const Motion& motion);

/// Enters the transmitted torque and its rate (central differences) into a path.
void set_torque(std::span<Instant<double>> path, std::span<const double> torque);

/// An instant as an effect across the transmission sees it: the torsion is motor and load, ratio 1.
template <class S>
Instant<S> across_transmission(Instant<S> x) {
  x.motor_angle = x.load_angle = x.torsion;
  x.motor_speed = x.load_speed = x.torsion_rate;
  x.motor_acceleration = x.load_acceleration = x.torsion_acceleration;
  x.gear_ratio = S(1.0);
  return x;
}

/// Where an effect enters: at its row's site, or across the transmission.
inline Site site_of(const EffectRow& row, const EffectSpec& spec) {
  return spec.across ? Site::transmission : row.site;
}

/// What an effect adds at its site along a path, its memory starting unloaded at the first instant.
/// Errors: a number of parameters that does not fit.
Result<std::vector<double>> terms_along(const EffectRow& row, const EffectSpec& spec,
                                        std::span<const Instant<double>> path);

/// Adds the effect to a signal at its site; an effect with a map changes the signal by it instead.
Result<void> apply_along(const EffectRow& row, const EffectSpec& spec,
                         std::span<const Instant<double>> path, std::span<double> signal);

}  // namespace flexspline
