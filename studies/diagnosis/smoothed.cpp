#include "diagnosis/smoothed.hpp"

#include <utility>

namespace flexspline::studies {

Result<DriveChannels> smoothed(const Recording& recording, std::vector<double> signal) {
  Recording view;
  view.id = recording.id;
  view.time = recording.time;
  view.channels[Quantity::torsion] = std::move(signal);
  return drive_channels(Rig::specimen, {}, view);
}

}  // namespace flexspline::studies
