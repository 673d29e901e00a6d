#pragma once

#include "readers/description.hpp"

namespace flexspline::data {

/// Fills what dropouts left (NaN, where valid is 0) between its neighbours, straight in time.
/// Findings: fewer than 16 valid samples; a channel that is constant where the rig's equations need
/// its variation; a pause longer than a hundred times the rest. Notes: dropouts, and holes in time
/// of more than twenty usual steps.
void check_recording(Recording& recording, Rig rig, const std::vector<Channel>& channels,
                     const std::string& file, DatasetReading& reading);

}  // namespace flexspline::data
