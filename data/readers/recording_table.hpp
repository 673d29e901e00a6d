#pragma once

#include "readers/description.hpp"

namespace flexspline::data {

/// Fills time and channels of a recording from its table, in SI, such that the rest can compute
/// with them. A column that is no channel is a note. Findings: those of read_csv and of
/// check_recording.
Recording read_table(const RecordingEntry& entry, Rig rig, const std::vector<Channel>& channels,
                     DatasetReading& reading);

}  // namespace flexspline::data
