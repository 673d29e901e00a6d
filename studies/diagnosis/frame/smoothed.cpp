#include "diagnosis/frame/smoothed.hpp"

#include <utility>

namespace flexspline::studies {

Result<DriveChannels> smoothed(const Recording& recording, std::vector<double> signal,
                               Resolution resolution) {
  Recording view;
  view.id = recording.id;
  view.time = recording.time;
  view.channels[Quantity::torsion] = std::move(signal);
  return drive_channels(Rig::specimen, {}, view, resolution);
}

}  // namespace flexspline::studies
