#pragma once

#include "flexspline/core/error.hpp"
#include "flexspline/core/recording.hpp"

namespace flexspline {

/// The torsion law's view of one recording.
/// Errors: a channel or the gear ratio that the rig needs is missing (input), named with the
/// recording. The servo rig measures no torque across the transmission and has no such view.
Result<TorsionRecord> torsion_record(const RecordingSet& set, const Recording& recording);

/// The view of all recordings of a set, in their order.
Result<std::vector<TorsionRecord>> torsion_records(const RecordingSet& set);

}  // namespace flexspline
