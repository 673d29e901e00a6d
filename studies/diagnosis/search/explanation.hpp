#pragma once

#include "diagnosis/search/selection.hpp"

namespace flexspline::studies {

/// True where a coordinate orders more of a residual than noise and small errors of form do, and
/// half of a size of interest.
bool is_left(const CoordinateScore& score, const Limits& limits);

/// Of the causes too small to be named the one that takes most away, if it is worth as much as a
/// named one, orders as much as a remainder and has half of a size of interest: the baseline alone
/// is then no explanation. Null where there is none, and beside named causes, whose forms may be
/// what it mends.
const Accepted* left_unnamed(const Selection& s, const Limits& limits);

/// True where more than noise is left: the model's own error is larger than the noise, and no
/// trifle.
bool is_beyond_noise(const Frame& frame, const HoldoutProof& proof, const Limits& limits);

/// The same of an equation on the rows that it was fitted to.
bool is_fitted_beyond_noise(const Frame& frame, const Findings& findings, const Limits& limits);

}  // namespace flexspline::studies
