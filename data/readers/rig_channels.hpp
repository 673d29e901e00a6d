#pragma once

#include <string>
#include <vector>

#include "flexspline/core/recording.hpp"
#include "readers/description.hpp"

namespace flexspline::data {

/// What the channels lack for their rig (or have too much of), one sentence each.
std::vector<std::string> rig_complaints(Rig rig, const std::vector<Channel>& channels);

/// Units in which results on these channels are shown: those of a specimen's own channels, degrees
/// for drives.
DisplayUnits display_units(Rig rig, const std::vector<Channel>& channels);

}  // namespace flexspline::data
