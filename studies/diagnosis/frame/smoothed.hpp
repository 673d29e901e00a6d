#pragma once

#include <vector>

#include "flexspline/core/recording.hpp"
#include "flexspline/core/rig_residuals.hpp"

namespace flexspline::studies {

/// A signal at the instants of a recording, in its own unit, smoothed as its motions are
/// (drive_channels): as torsion, torsion_rate and torsion_acceleration, the signal and its
/// derivatives by time, 1/s and 1/s2. Errors: those of drive_channels.
Result<DriveChannels> smoothed(const Recording& recording, std::vector<double> signal,
                               Resolution resolution);

}  // namespace flexspline::studies
