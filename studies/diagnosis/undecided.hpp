#pragma once

#include <string>

#include "diagnosis/finding.hpp"

namespace flexspline::studies {

/// The diagnosis of recordings that look mistaken: undecided, without a fit, with what they look
/// like.
/// Errors: bad_data where a channel is the same number in every recording.
Result<Diagnosis> mistaken_diagnosis(const RecordingSet& set,
                                     std::vector<data::SanityFinding> findings);

/// Causes that are no physics: larger than half of the torque, but for friction across the gear and
/// a late torque of a joint that travels, which may be; and gains of a channel that are off by 40 %
/// or more.
std::vector<data::SanityFinding> implausible(const Frame& frame, const Selection& selection,
                                             const Limits& limits);

/// Share of the variance of the measured torque that the final model follows, in the equation to
/// prove.
double share_followed(const Frame& frame, const Selection& selection);

/// Takes causes and certainty out of a diagnosis that cannot be decided.
void make_undecided(std::string says, Diagnosis& diagnosis);

}  // namespace flexspline::studies
