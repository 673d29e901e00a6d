#pragma once

#include "readers/description.hpp"

namespace flexspline::data {

/// Fills time and channels of a recording from its table, in SI.
/// Findings: those of the table, a missing column, fewer than 16 samples, time that does not
/// increase. A column that is no channel is a note.
Recording read_table(const RecordingEntry& entry, const std::vector<Channel>& channels,
                     DatasetReading& reading);

}  // namespace flexspline::data
