#pragma once

#include "flexspline/core/drive_spec.hpp"
#include "flexspline/core/error.hpp"
#include "flexspline/core/recording.hpp"

namespace flexspline::estimators {

/// The drive of a set with the constants it states, and torque constant, resistance and motor
/// inertia by the equation error: m g l sin theta + m l^2 theta'' = (kt/R) V - (kt ke/R) theta' -
/// J theta'' - c sgn theta', by non-negative least squares over all training recordings.
/// Errors: input_missing for a channel or constant, numerics where they tell no torque constant.
Result<DriveSpec> servo_start(const RecordingSet& set,
                              const std::vector<const Recording*>& recordings);

}  // namespace flexspline::estimators
