#pragma once

#include <string_view>
#include <vector>

#include "diagnosis/frame/frame.hpp"
#include "flexspline/core/rig_residuals.hpp"
#include "flexspline/core/torsion_record.hpp"

namespace flexspline::studies {

/// The equations that the channels of a recording and the constants of its set allow.
/// Errors: bad_data where they allow none.
Result<std::vector<Equation>> equations_of(const RecordingSet& set, std::string_view recording,
                                           const DriveChannels& channels);

}  // namespace flexspline::studies
