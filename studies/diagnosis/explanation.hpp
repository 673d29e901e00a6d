#pragma once

#include "diagnosis/selection.hpp"

namespace flexspline::studies {

/// Share of the misfit beyond noise that the accepted causes remove, over all equations.
double misfit_removed(const Frame& frame, const Selection& s);

/// True where a coordinate orders more of a residual than noise and small errors of form do.
bool is_left(const CoordinateScore& score, const Limits& limits);

/// Of the causes too small to be named the one that takes most away, if it is worth as much as a
/// named one and orders as much as a remainder: the baseline alone is then no explanation. Null
/// where there is none, and beside named causes, whose forms may be what it mends.
const Accepted* left_unnamed(const Selection& s, const Limits& limits);

/// Largest mean square over noise of an equation.
double worst_misfit(const Frame& frame, const Findings& findings);

/// True where more causes are accepted than may stand together, one less where something is left.
bool too_many(const Selection& s, const Limits& limits);

/// True where the accepted causes may stand as the explanation: they leave little that anything
/// could order, and they remove most of the misfit, or leave no more than noise does.
bool explains_enough(const Frame& frame, const Selection& s, const Limits& limits);

/// True for a cause that stands although much is left: its own coordinate stood out in the
/// baseline's residual, and with the causes nothing is ordered by anything any more. What is left
/// is then something else, without a name.
bool clears_its_coordinate(const Selection& s, const Accepted& cause, const Limits& limits);

}  // namespace flexspline::studies
