#pragma once

#include "diagnosis/search/search.hpp"

namespace flexspline::studies {

/// The frame with every recording's torsion counted from where the findings fit it best: Gauss and
/// Newton's step of each zero, and the model fitted again, in turn. For recordings that have zeros
/// of their own (mountings of a specimen); the mean torsion at zero torque, from which they start,
/// is pulled to the side where a memory is loaded.
/// Errors: those of the fits.
Result<Frame> with_fitted_zeros(Frame frame, Findings findings);

}  // namespace flexspline::studies
