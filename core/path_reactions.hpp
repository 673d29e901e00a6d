#pragma once

#include <span>
#include <vector>

#include "flexspline/core/effect.hpp"

namespace flexspline {

/// What the transmission returns to the shaft of that angle along a path, by virtual work: the sum
/// over the effects of kinematics e of the integral of de/dtheta over the torque, and over those t
/// of the torsion law of dt/dtheta over the torsion; by the midpoint, exact for terms affine in
/// torque or torsion. seen: the path with the law's torsion; rigid: without the kinematics. Both
/// hold the transmitted torque; where it is 0 throughout, kinematics return nothing.
/// Errors: a number of parameters that does not fit.
Result<std::vector<double>> reactions_along(const ModelSpec& model,
                                            std::span<const Instant<double>> rigid,
                                            std::span<const Instant<double>> seen,
                                            double Instant<double>::*angle);

}  // namespace flexspline
