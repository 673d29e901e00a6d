#pragma once

#include <string>
#include <vector>

#include "diagnosis/model/model.hpp"

namespace flexspline::studies {

/// Three cycles of a sine that may be recorded next, no further and no faster than the recordings
/// go.
struct NextMotion {
  Frame frame;             ///< its motion and the torques that the model predicts along it
  double amplitude = 0.0;  ///< of the torsion; where the output turns, of its angle, rad (m)
  double frequency_hz = 0.0;
  std::string says;  ///< what moves as a sine, in words
};

/// What the rig can be made to do. A motion is imposed: a torsion where the output is held or a
/// specimen wound, else the angle of the output, about the middle of what was recorded. On the free
/// rig a torque of the motor drives, A cos(w t) from rest, and the motion is that of the model; one
/// that goes beyond the recordings is left out, as is one that cannot be integrated.
std::vector<NextMotion> next_motions(const Frame& like, const DriveModel& model);

}  // namespace flexspline::studies
