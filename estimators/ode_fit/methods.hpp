#pragma once

#include "ode_fit/layout.hpp"

namespace flexspline::estimators {

Result<OdeSolution> single_shooting(const OdeLayout& layout, const OdeFitSettings& settings);
Result<OdeSolution> multiple_shooting(const OdeLayout& layout, const OdeFitSettings& settings);
/// Errors: usage when the system has no second derivatives.
Result<OdeSolution> collocation(const OdeLayout& layout, const OdeFitSettings& settings);

}  // namespace flexspline::estimators
