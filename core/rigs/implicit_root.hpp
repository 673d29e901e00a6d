#pragma once

#include <cmath>
#include <limits>
#include <type_traits>

#include "flexspline/core/scalar.hpp"

namespace flexspline {

/// The complex residual's root on the real axis, by Newton within a bracket that grows from
/// +-scale; the slope is exact by a complex step. Increasing residuals have one root. NaN where
/// none is found. slope: d residual / dv at the root.
template <class Residual>
double real_root(const Residual& residual, double scale, double& slope) {
  constexpr double kStep = 1e-30;
  const auto value = [&](double v) { return residual(Complex(v)).real(); };
  double low = -scale;
  double high = scale;
  while (value(low) > 0.0 && std::isfinite(low)) low *= 4.0;
  while (value(high) < 0.0 && std::isfinite(high)) high *= 4.0;
  if (!std::isfinite(low) || !std::isfinite(high)) return std::nan("");
  double v = 0.0;
  for (int k = 0; k < 200; ++k) {
    const Complex at = residual(Complex(v, kStep));
    slope = at.imag() / kStep;
    if (at.real() == 0.0) return v;
    (at.real() > 0.0 ? high : low) = v;
    double next = v - at.real() / slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const double moved = std::abs(next - v);
    v = next;
    if (moved <= 1e-14 * std::abs(v) + 1e-18 * scale) break;
  }
  slope = residual(Complex(v, kStep)).imag() / kStep;
  return v;
}

/// An increasing residual's root by secants within a bracket that grows; plain numbers alone, a
/// fifth of the cost of complex ones. NaN where none is found. Errs by 1e-13 of root and scale.
template <class Residual>
double secant_root(Residual&& residual, double scale) {
  constexpr double kEnd = 1e-13;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  double before = 0.0;
  double value_before = residual(before);
  double v = value_before > 0.0 ? -scale : scale;
  for (int k = 0; k < 200 && value_before != 0.0; ++k) {
    (value_before > 0.0 ? high : low) = before;
    const double value = residual(v);
    if (!std::isfinite(value)) return std::nan("");
    double next = v - value * (v - before) / (value - value_before);
    (value > 0.0 ? high : low) = v;
    const bool bracketed = std::isfinite(low) && std::isfinite(high);
    if (!(next > low && next < high)) next = bracketed ? 0.5 * (low + high) : 5.0 * v;
    before = v;
    value_before = value;
    v = next;
    if (std::abs(v - before) <= kEnd * (std::abs(v) + scale)) return v;
  }
  return before;
}

/// The root with the derivatives that the residual's own scalar carries: one Newton step from the
/// real root is exact to first order.
template <class S, class ComplexResidual, class Residual>
S implicit_root(const ComplexResidual& complex_residual, const Residual& residual, double scale) {
  double slope = 0.0;
  const double root = real_root(complex_residual, scale, slope);
  if constexpr (std::is_same_v<S, double>) {
    return root;
  } else {
    const S off = residual(S(root));
    return root - (off - real_part(off)) / slope;
  }
}

/// The same with the root by secants of plain numbers; complex ones for its slope alone.
template <class S, class RealResidual, class ComplexResidual, class Residual>
S implicit_root(RealResidual real_residual, ComplexResidual complex_residual,
                const Residual& residual, double scale) {
  constexpr double kStep = 1e-30;
  const double root = secant_root(real_residual, scale);
  const double slope = complex_residual(Complex(root, kStep)).imag() / kStep;
  const S off = residual(S(root));
  return root - (off - real_part(off)) / slope;
}

}  // namespace flexspline
