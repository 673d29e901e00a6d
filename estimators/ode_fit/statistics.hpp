#pragma once

#include "ode_fit/layout.hpp"

namespace flexspline::estimators {

/// The solution with residuals, covariance and intervals, from the sensitivities of the trajectory
/// at it.
OdeFit with_statistics(const OdeLayout& layout, const OdeSolution& solution,
                       const OdeFitSettings& settings);

}  // namespace flexspline::estimators
