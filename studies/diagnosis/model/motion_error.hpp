#pragma once

#include "diagnosis/model/model.hpp"

namespace flexspline::studies {

/// What the errors s of the motions v (Frame::torsion_error and those beside it) do to what a model
/// leaves of each equation, Nm by row: the root of the sum of (|r(v + s) - r(v - s)|/2)^2 over
/// independent errors, of the torsion, its rate, the motor's speed, and the accelerations. A model
/// that turns on a motion, as hysteresis and friction do about a reversal and a spring where it is
/// kicked, tells no more there than the motion is known. On a locked rig the torsion's rate is the
/// motor's speed, on a servo both accelerations are one; on specimens the rate alone. Empty where
/// the rate's error is not known.
PerEquation torque_of_motion_error(const Frame& frame, const DriveModel& model,
                                   const Reference& reference);

}  // namespace flexspline::studies
