#pragma once

#include <optional>

#include "diagnosis/search/selection.hpp"

namespace flexspline::studies {

/// The stretch of one recording that stands out of it as no other recording has one: by the power
/// of its residual over the recording's own, by a pulse or by a step to its end. Its log likelihood
/// ratio has to exceed that of a search over all stretches on noise, and nine tenths of it what is
/// like it anywhere. Or a step that the model has taken (step_taken), which has to exceed the same
/// and to be nine tenths of all that is missing. Either has to matter (limits.trifle(), rms). None
/// where there is none.
std::optional<Incident> find_incident(const Frame& frame, const Findings& findings,
                                      const Limits& limits);

/// The frame without the rows of an incident.
Frame without_incident(Frame frame, const Incident& incident);

}  // namespace flexspline::studies
