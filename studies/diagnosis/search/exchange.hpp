#pragma once

#include "diagnosis/search/selection.hpp"

namespace flexspline::studies {

/// Each accepted cause against its alternatives, beside the others as they are at the end: where
/// one of them has the larger net gain (the marginal likelihood, to first order) it takes the
/// cause's place, which becomes an alternative. When a cause was accepted, those that came after it
/// were not in the model, and what differed between alternatives may have been theirs.
/// Errors: those of fits.
Result<void> exchange_for_better(const Frame& frame, const Limits& limits, Selection& selection);

}  // namespace flexspline::studies
