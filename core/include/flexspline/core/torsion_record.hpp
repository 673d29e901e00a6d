#pragma once

#include "flexspline/core/error.hpp"
#include "flexspline/core/recording.hpp"

namespace flexspline {

/// Whether the torque across a free drive's gear is told by its load alone: no recording measures
/// it, and the set states load_inertia_kgm2. It is J2 theta_l'' then, without a drag at the load.
bool has_torque_by_inertia(const RecordingSet& set);

/// The torsion law's view of one recording; without a torque sensor that of the load's inertia
/// (has_torque_by_inertia), along the angle smoothed as drive_channels() does.
/// Errors: a channel or the gear ratio that the rig needs is missing (input), named with the
/// recording. The servo rig measures no torque across the transmission and has no such view.
Result<TorsionRecord> torsion_record(const RecordingSet& set, const Recording& recording);

/// The view of all recordings of a set, in their order.
Result<std::vector<TorsionRecord>> torsion_records(const RecordingSet& set);

}  // namespace flexspline
