#pragma once

#include <vector>

#include "flexspline/studies/trial.hpp"

namespace flexspline::studies {

/// What the recordings of a concealed case show of each of its effects once the baseline has taken
/// up what it can: the baseline is fitted to them, and to those of the same drive, design and noise
/// without the effect; its residuals differ by the trace. Needs no cause, no catalogue and no
/// diagnosis. Errors: those of concealing and of the baseline's fit.
Result<std::vector<EffectTrace>> traces_of(const ConcealPlan& plan, const RecordingSet& recordings);

}  // namespace flexspline::studies
