#pragma once

#include "diagnosis/search/selection.hpp"

namespace flexspline::studies {

/// Puts the form before it in the place of a form that extends it by one shape
/// (CauseForm::extends), where that shape is worth less than a cause would have to be.
Result<void> take_plain_forms(const Frame& frame, const Limits& limits, Selection& selection);

}  // namespace flexspline::studies
