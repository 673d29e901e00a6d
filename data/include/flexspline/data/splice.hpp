#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "flexspline/data/hidden_bench.hpp"

namespace flexspline::data {

/// Which of the bench's benches recordings come from: a joint where a specimen's angle travels.
BenchKind kind_of(const RecordingSet& set);

/// Ids of catalogued effects that can be added to the torque of recordings that others made: what
/// a specimen's law, load or torque sensor adds as a function of motion, torque and time. What acts
/// in series with the spring or on an angle cannot be added to a torque.
std::vector<std::string> spliceable(const RecordingSet& set);

/// Recordings with a known effect added to their torque, and what was added.
struct SplicedSet {
  RecordingSet set;
  HiddenFinding finding;
  double peak_torque = 0.0;  ///< Nm (N), the largest measured
};

/// Adds to the measured torque (or force) what an effect makes of the measured motion: rates and
/// accelerations by local parabolas over 11 samples, memories from the first sample on. Its amount
/// is found by repetition until the largest addition is size_fraction of the largest torque, to
/// 2 %. Samples marked as not valid stay as they are.
/// Errors: usage for an effect that is not spliceable, or a size that these recordings cannot show.
Result<SplicedSet> splice(const RecordingSet& set, const HiddenEffect& effect, std::uint64_t seed);

/// A change of recordings that changes nothing of the physics: none, mirrored (every signed channel
/// negative), every_second (sample), first_70 (percent of each recording), one_left_out (recording,
/// by the seed).
std::span<const std::string_view> splice_changes();

/// Errors: usage for a change that there is not, or recordings too few or too short for it.
Result<RecordingSet> changed(RecordingSet set, std::string_view change, std::uint64_t seed);

}  // namespace flexspline::data
