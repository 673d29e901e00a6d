#pragma once

#include "flexspline/core/signals.hpp"

namespace flexspline {

/// reconstruct() for a record whose steady part has been looked for already.
Result<Reconstruction> reconstruct_with(const TorsionRecord& record,
                                        const std::optional<SteadyPart>& steady);

}  // namespace flexspline
