#pragma once

#include "flexspline/core/recording.hpp"

namespace flexspline {

/// How closely a smoothed motion follows its samples. Even: for what drives a simulation, and where
/// accelerations count. Fine: for motions that friction lets go at once, judged sample by sample.
enum class Resolution { even, fine };

/// How closely the motions of a rig are followed where a law is judged by the sample: of a drive as
/// its friction lets them go, of a specimen evenly, whose motion is imposed and whose inertia shows
/// by its acceleration.
inline Resolution resolution_on(Rig rig) {
  return rig == Rig::specimen ? Resolution::even : Resolution::fine;
}

}  // namespace flexspline
