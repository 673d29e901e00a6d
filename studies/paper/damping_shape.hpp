#pragma once

namespace flexspline::studies {

/// c (v/v0)^n through Table I's g^-1 on [0, v0], by least squares.
struct PowerLaw {
  double coefficient = 0.0;  ///< Nm
  double exponent = 0.0;
  double rms_percent = 0.0;  ///< of the largest g^-1
};
PowerLaw fit_power_law();

/// rms, in percent of the largest g^-1, of the best multiple of one shape s(v/v0).
double shape_misfit_percent(double (*shape)(double));

/// Condition number of the design matrix x, x^3, …, x^9 over one loop in the published units.
/// One-sided Jacobi: columns differ by many orders of magnitude.
double vandermonde_condition(double range);

}  // namespace flexspline::studies
