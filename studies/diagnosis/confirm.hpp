#pragma once

#include <string>
#include <vector>

#include "diagnosis/prove.hpp"

namespace flexspline::studies {

/// Ids of at most two effects that explain the same signal as an accepted cause and are not named
/// themselves: what is named beside a cause is told apart from it.
std::vector<std::string> alternatives_of(const Accepted& accepted, const Selection& selection);

/// The proof of the causes that stand: those that recordings held out confirm, and whose name, or
/// one of its alternatives, is right with limits.probability at least. The worst is withdrawn, what
/// is not confirmed before what is improbable, or a rival that holds takes its place, and all is
/// proved anew; at the end the misfit is located.
Result<Proof> confirm(const Frame& frame, const Limits& limits, Selection& selection);

}  // namespace flexspline::studies
