#pragma once

#include <vector>

#include "flexspline/estimators/ode_fit.hpp"
#include "flexspline/estimators/servo_fit.hpp"

namespace flexspline::estimators {

/// The fit of a servo's problem from the start it names, from several, or from where searches
/// without derivatives end. copies: the problem, as often as threads may work at it.
/// One that is not the same when simulated again does not count as converged.
/// Errors: usage for both several starts and searches; those of fit_ode and search_ode.
Result<OdeFit> solve_servo(const std::vector<OdeFitProblem>& copies, const ServoSettings& settings);

}  // namespace flexspline::estimators
