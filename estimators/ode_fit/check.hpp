#pragma once

#include "flexspline/estimators/ode_fit.hpp"

namespace flexspline::estimators {

/// Errors: bad_data, by name and value, where the description breaks its own rules.
Result<void> check(const OdeFitProblem& problem);

/// Errors: usage, where settings are out of range or do not go together.
Result<void> check(const OdeFitSettings& settings);

}  // namespace flexspline::estimators
