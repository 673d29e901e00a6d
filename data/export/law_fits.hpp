#pragma once

#include "flexspline/core/law.hpp"

namespace flexspline::data {

/// Where a law is trusted: valid_to, or its scale.
double domain_of(const LawSpec& law);

/// a x + c x^3 nearest to an odd law over its domain (least squares), a, c >= 0; the law itself
/// where it is one.
Result<LawSpec> cubic_spring(const LawSpec& law);

/// a x + b x|x| + c x^3 nearest to an odd law over its domain, a, b, c >= 0, as a monotone_spline
/// without knots: that polynomial up to the scale.
Result<LawSpec> cubic_damper(const LawSpec& law);

/// Coefficients of x, x^2 and x^3 for x >= 0 of what cubic_spring or cubic_damper gave.
std::array<double, 3> polynomial_of(const LawSpec& law);

}  // namespace flexspline::data
