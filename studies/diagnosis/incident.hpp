#pragma once

#include <optional>

#include "diagnosis/selection.hpp"

namespace flexspline::studies {

/// The stretch of one recording that stands out of it as no other recording has one: by the power
/// of its residual over the recording's own, or by a step. Its log likelihood ratio has to exceed
/// that of a search over all stretches on noise, nine tenths of what is like it anywhere,
/// and it has to matter (limits.trifle(), rms). None where there is none.
std::optional<Incident> find_incident(const Frame& frame, const Findings& findings,
                                      const Limits& limits);

/// The frame without the rows of an incident.
Frame without_incident(Frame frame, const Incident& incident);

}  // namespace flexspline::studies
