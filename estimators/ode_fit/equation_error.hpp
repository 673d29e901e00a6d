#pragma once

#include <optional>

#include "ode_fit/layout.hpp"

namespace flexspline::estimators {

/// Where to start a fit from the measurements alone: each output smoothed, its slope collocated
/// with the law, and least squares over the parameters (one solution where the law is linear in
/// them, whatever the start). Biased by noise, so a start and no estimate. Free initial values are
/// read off the smooth curves. Absent where a state is not shown by an output of its own, or where
/// the law cannot be evaluated along the curves.
std::optional<std::vector<double>> equation_error_start(const OdeLayout& layout);

}  // namespace flexspline::estimators
