#pragma once

#include "flexspline/core/recording.hpp"

namespace flexspline::studies {

/// Largest minus smallest motion over the valid samples, rad (m).
double motion_range(const TorsionRecord& record);

}  // namespace flexspline::studies
