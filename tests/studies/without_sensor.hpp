#pragma once

#include "flexspline/core/recording.hpp"

namespace flexspline::studies {

/// The recordings of a bench that has no torque sensor.
inline RecordingSet without_sensor(RecordingSet set) {
  for (Recording& recording : set.recordings) {
    recording.channels.erase(Quantity::transmitted_torque);
  }
  return set;
}

}  // namespace flexspline::studies
