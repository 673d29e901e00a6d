#pragma once

#include <span>
#include <vector>

#include "flexspline/core/effect.hpp"
#include "flexspline/core/law.hpp"

namespace flexspline {

struct TorsionLaws {
  const Law& f;
  const Law& g_inverse;
  const Law& h;
};

/// Whether kinematics of the model follow the torque that they help to make.
/// Errors: an effect that does not exist or whose parameters do not fit.
Result<bool> kinematics_follow_torque(const ModelSpec& model);

/// The torque along a path with such kinematics e, forces included, instruments not: at each
/// instant tau = law(phi + e(tau), phi' + e') + forces, by Newton within a bracket around the last
/// torque. e' is that of the polynomial through the last five instants of e (fewer after the start,
/// where it is 0): fourth order in the interval.
/// Errors: numerics, with the instant, where no root can be bracketed or it is not stable.
Result<std::vector<double>> torque_of_yielding(const TorsionLaws& laws, const ModelSpec& model,
                                               std::span<const Instant<double>> path);

}  // namespace flexspline
