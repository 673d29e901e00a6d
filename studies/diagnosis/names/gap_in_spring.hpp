#pragma once

#include "diagnosis/proof/prove.hpp"

namespace flexspline::studies {

/// The frame with a firm spring: f has no slope below 0.6 of its mean one (a strain-wave gear of
/// size 45 starts at 0.58 of its last stiffness), so that a gap cannot hide in its freedom.
Frame with_firm_spring(Frame frame);

/// Slope of f through the middle tenth of the torsion range over its mean one; NaN without a
/// torsion equation, or where the angle travels.
double softness(const Frame& frame, const Selection& selection);

/// True where there is an f of the torsion, no gap is named, and f is softer in its middle than
/// springs of gears are, or a column of its equation that it counteracts gains all the same: f half
/// hides something, and a firm one would not (docs/decisions/0039).
bool may_hide_a_gap(const Frame& frame, const Selection& selection, const Limits& limits);

/// The same causes beside the other spring, the frame with it and the model fitted anew.
struct OtherSpring {
  Frame frame;
  Findings findings;
};

/// True where a gap of the torsion is among the causes, of which f may have a part.
bool has_shared_gap(const Frame& frame, const Selection& selection);

/// The model beside a firm spring in place of a free one, or the reverse. Of what is flat f may
/// have any part that leaves it as firm as springs of gears are, so that a gap is as wide as with
/// either, or between (docs/decisions/0044). Errors: numerics, where it cannot be fitted.
Result<OtherSpring> with_other_spring(const Frame& frame, const Selection& selection);

/// True where a gap is among the causes or what may take their place.
bool has_a_gap(const Selection& selection);

/// True where the model with a firm spring names a gap and predicts recordings held out as well as
/// that with the free one does, for all that they can tell: its error lies within the interval of
/// 95 % of the other's. Of two such models the one stands whose spring is one.
bool tells_a_gap(const Selection& firm, const Proof& with_free_f, const Proof& with_gap,
                 const Limits& limits);

}  // namespace flexspline::studies
