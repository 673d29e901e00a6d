#pragma once

#include <vector>

#include "flexspline/core/estimate.hpp"
#include "flexspline/core/recording.hpp"
#include "flexspline/estimators/method.hpp"
#include "flexspline/estimators/midpoint_locus.hpp"

namespace flexspline::estimators {

/// The option `speed` that the midpoint methods share, and what a problem chose.
OptionInfo locus_speed_option();
LocusSpeed locus_speed(const FitProblem& problem, const MethodRow& method);

/// f and g^-1 as odd five-term polynomials by linear least squares over all loci, h = 1, eqs.
/// (20)-(25): g^-1 from Xd = [g^-1(v1) + g^-1(v2)]/2, then f from Xm - [g^-1(v1) - g^-1(v2)]/2. The
/// Vandermonde matrices are scaled by the largest amplitude and speed, which changes the
/// conditioning and nothing else.
Estimate polynomial_estimate(std::string estimator, const std::vector<MidpointLocus>& loci,
                             const std::vector<TorsionRecord>& records);

}  // namespace flexspline::estimators
