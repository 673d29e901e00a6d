#pragma once

#include <vector>

#include "diagnosis/prove.hpp"

namespace flexspline::studies {

/// Puts causes whose names are improbable back into the model, without their names, where the
/// confirmed model leaves something: a doubted name is no reason to predict worse. Those that
/// recordings held out no longer confirm beside the others stay withdrawn, and all of them where
/// one would be implausible. What is returned has the errors of the whole model, and of the named
/// causes what was said of them without the unnamed.
Result<Proof> with_unnamed(const Frame& frame, const Limits& limits,
                           std::vector<Accepted> improbable, Proof named, Selection& selection);

}  // namespace flexspline::studies
