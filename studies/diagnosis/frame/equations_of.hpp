#pragma once

#include <string_view>
#include <vector>

#include "diagnosis/frame/frame.hpp"
#include "flexspline/core/rig_residuals.hpp"

namespace flexspline::studies {

/// Whether the torque across a free drive's gear is that of its load's inertia: none of its
/// recordings measures it, and the set states the inertia (Frame::torque_by_inertia).
bool has_torque_by_inertia(const RecordingSet& set);

/// The equations that the channels of a recording and the constants of its set allow.
/// Errors: bad_data where they allow none.
Result<std::vector<Equation>> equations_of(const RecordingSet& set, std::string_view recording,
                                           const DriveChannels& channels);

}  // namespace flexspline::studies
