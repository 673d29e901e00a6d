#pragma once

#include "diagnosis/search/selection.hpp"

namespace flexspline::studies {

/// Takes out of the model what the other causes explain as well, and a cause of which the errors of
/// form of a larger one of the same equation may be all that it explains; the least first, each
/// time fitted anew. Material ones go to those withdrawn. Each that stays is weighed with the noise
/// that the whole model leaves.
Result<void> take_out_needless(const Frame& frame, const Limits& limits, Selection& selection);

}  // namespace flexspline::studies
