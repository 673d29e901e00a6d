#pragma once

#include "flexspline/estimators/ode_fit.hpp"

namespace flexspline::estimators {

/// Errors: bad_data, by name and value, where the description breaks its own rules.
Result<void> check(const OdeFitProblem& problem);

}  // namespace flexspline::estimators
