#pragma once

#include "diagnosis/prove.hpp"

namespace flexspline::studies {

/// The frame with a plain spring, f = k1 x + k3 x^3 with k1, k3 >= 0, instead of a spline: beside
/// it a gap cannot hide in the freedom of f.
Frame with_plain_spring(Frame frame);

/// Slope of f through the middle tenth of the torsion range over its mean one; NaN without a
/// torsion equation, or where the angle travels.
double softness(const Frame& frame, const Selection& selection);

/// True where no gap is named and f is softer in its middle than springs of gears are.
bool may_hide_a_gap(const Frame& frame, const Selection& selection);

/// True where the model with a plain spring names a gap and predicts recordings held out as well as
/// that with the spline does, for all that they can tell: its error lies within the spline's
/// interval of 95 %. Of two such models the simpler one stands.
bool tells_a_gap(const Selection& plain, const Proof& with_spline, const Proof& with_gap);

}  // namespace flexspline::studies
