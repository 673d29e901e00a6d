#pragma once

#include <span>
#include <vector>

#include "flexspline/core/recording.hpp"
#include "flexspline/core/rig.hpp"
#include "flexspline/core/rig_residuals.hpp"

namespace flexspline::studies {

/// Where the levels of an encoder tell how fast its angle moves, 1 by sample, else 0. A smoothing
/// of this bandwidth (1/s) keeps w up to it; levels that are passed tell such a motion where two
/// or more come in its period, 2 pi/bandwidth or two samples (sampling theorem). Slower, what is
/// smoothed are the levels: an angle that creeps past one of them looks like one that moves and
/// rests. 1 everywhere where an angle has no levels.
std::vector<double> counted(std::span<const double> time, std::span<const double> angle,
                            double bandwidth);

/// The same of a recording's motor, by the encoder that tells its angle: its own, or the load's of
/// a servo. 1 everywhere where there is none.
std::vector<double> counted_motor(const Recording& recording, double bandwidth);

/// Standard deviation of the torsion by sample, rad: of its smoothing and, on locked and free
/// drives, of where the angle stands within a level q of an encoder, q/sqrt(12), as long as its
/// levels do not tell the motion (counted()) and no mean is taken over them. An angle that rests is
/// not known better for being read a thousand times.
std::vector<double> torsion_error(const Recording& recording, Rig rig, double ratio,
                                  const DriveChannels& smooth);

}  // namespace flexspline::studies
