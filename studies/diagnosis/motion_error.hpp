#pragma once

#include "diagnosis/model.hpp"

namespace flexspline::studies {

/// What the errors s of the motions v (Frame::torsion_rate_error and those beside it) do to what a
/// model leaves of each equation, Nm by row: the root of the sum of (|r(v + s) - r(v - s)|/2)^2
/// over independent errors, of the torsion's rate, the motor's speed, and the accelerations. A
/// model that turns on a rate, as hysteresis and friction do about a reversal, tells no more there
/// than the rate is known, nor an inertia where it is kicked. On a locked rig the torsion's rate is
/// the motor's speed; on specimens the rate alone. Errors of angles are not in it. Empty where the
/// rate's is not known, and on a servo.
PerEquation torque_of_motion_error(const Frame& frame, const DriveModel& model,
                                   const Reference& reference);

}  // namespace flexspline::studies
