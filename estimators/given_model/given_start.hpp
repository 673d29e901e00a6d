#pragma once

#include "given_model/given_residuals.hpp"

namespace flexspline::estimators {

/// Where a fit of a given model may start: the unknowns in which the torque is affine (found by
/// trial) by least squares within their bounds, the others by at most that many steps from their
/// own starts (separable least squares).
/// Errors: numerics, where the model cannot be simulated at the starts.
Result<std::vector<double>> given_start(const GivenResiduals& problem, int most_steps);

}  // namespace flexspline::estimators
