#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/names/finding.hpp"

namespace flexspline::studies {

/// The diagnosis of recordings that look mistaken: undecided, without a fit, with what they look
/// like.
/// Errors: bad_data where a channel is the same number in every recording.
Result<Diagnosis> mistaken_diagnosis(const RecordingSet& set,
                                     std::vector<data::SanityFinding> findings);

/// Causes that are no physics: more than half of the torque, but for friction across the gear, an
/// inertia that nothing bounds, a late torque of a motor and changes of the motion, which may be;
/// gains of a channel that are off by half or more; inertias that take half or more of what is
/// stated away.
std::vector<data::SanityFinding> implausible(const Frame& frame, const Selection& selection,
                                             const Limits& limits);

/// Why recordings decide nothing, whatever was found in them.
struct Undecidable {
  std::string says;
  std::vector<data::SanityFinding> mistaken{};
  std::optional<NextExperiment> experiment{};  ///< that would decide
};

/// Causes that are no physics; one loop of one amplitude and one rate; no name and a torque whose
/// variance the model does not follow.
std::optional<Undecidable> undecidable(const Frame& frame, const Selection& selection,
                                       Verdict verdict, const Limits& limits);

/// Takes causes and certainty out of a diagnosis that cannot be decided.
void make_undecided(Undecidable why, Diagnosis& diagnosis);

}  // namespace flexspline::studies
