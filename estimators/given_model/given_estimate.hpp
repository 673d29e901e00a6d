#pragma once

#include "given_model/given_residuals.hpp"

namespace flexspline::estimators {

/// A fitted model with standard deviations (a sandwich for noise that neighbours share), bands of
/// the laws that have free coefficients, and what the recordings tell of the unknowns.
Estimate given_estimate(const GivenResiduals& problem, const LeastSquaresSolution& solution,
                        const Linearisation& linear, const std::vector<GivenRecord>& records);

}  // namespace flexspline::estimators
