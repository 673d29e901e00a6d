#pragma once

#include <string>
#include <vector>

#include "diagnosis/proof/prove.hpp"

namespace flexspline::studies {

/// Ids of at most two effects that explain the same signal as an accepted cause and are not named
/// themselves: what is named beside a cause is told apart from it.
std::vector<std::string> alternatives_of(const Accepted& accepted, const Selection& selection);

/// What tables without a name find beside each cause of the proof, the first ones accepted, in what
/// findings leave.
void take_left_over(const Frame& frame, const Findings& findings, const Selection& selection,
                    Proof& proof);

/// The proof of the causes that stay, with the evidence of their names. Of those that recordings
/// held out do not confirm the worst is withdrawn, and all is proved anew.
Result<Proof> confirm(const Frame& frame, const Limits& limits, Selection& selection);

}  // namespace flexspline::studies
