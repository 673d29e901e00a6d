#pragma once

#include "flexspline/core/drive_spec.hpp"
#include "flexspline/core/error.hpp"
#include "flexspline/core/recording.hpp"
#include "flexspline/core/simulate.hpp"

namespace flexspline {

/// The constants that a data set states of its bench, on a drive without laws.
DriveSpec stated_drive(const RecordingSet& set);

/// The torques that the bench would record along the motions recorded, each from its own equation
/// of Dhaouadi and Ghorbel (2003): transmitted_torque by (7), with the torsion recorded;
/// motor_torque by (5) under the torque recorded, or by (7) where none was; a servo's by (5) and
/// (6). Other channels are those recorded. Angles are smoothed as for a diagnosis; effects on
/// encoders are taken off them to first order, those on torque sensors entered in what is returned.
/// Errors: fewer than 16 samples, a channel that the rig needs, a law or effect that cannot be
/// made.
Result<Recording> torques_along(const RigModel& model, const Recording& recording);

/// The motions that the rig makes under the recorded motor torque (current, duty cycle) from the
/// recording's first angles on, at rest where the speed is not recorded, by CVODES; its channels
/// are the outputs of the rig. Inputs rise and fall between samples where they do. Errors: those of
/// make_rig and of the integration; a channel that drives the rig is missing.
Result<Recording> motions_under(const RigModel& model, const Recording& recording,
                                const IntegratorSettings& settings = {});

}  // namespace flexspline
