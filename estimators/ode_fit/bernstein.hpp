#pragma once

#include <span>

namespace flexspline::estimators {

/// The least value of a polynomial and where it is taken.
struct PolynomialLeast {
  double value = 0.0;
  double at = 0.0;
};

/// The least of c0 + c1 s + c2 s^2 + ... over 0 <= s <= 1: by Bernstein's coefficients, which bound
/// it from below, halving the interval until they are within `tolerance` of a value taken. What is
/// returned exceeds the true least value by at most that.
PolynomialLeast least_on_unit(std::span<const double> coefficients, double tolerance);

}  // namespace flexspline::estimators
