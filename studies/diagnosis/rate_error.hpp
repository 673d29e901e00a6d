#pragma once

#include "diagnosis/model.hpp"

namespace flexspline::studies {

/// What the error s of the torsion's rate v (Frame::torsion_rate_error) does to what a model leaves
/// of each equation, Nm by row: |r(v + s) - r(v - s)|/2. A model that turns on the rate, as
/// hysteresis and friction do about a reversal, tells no more there than the rate is known. Errors
/// of the other motions are not in it. Empty where the rate's is not known, and on a servo.
PerEquation torque_of_rate_error(const Frame& frame, const DriveModel& model,
                                 const Reference& reference);

}  // namespace flexspline::studies
