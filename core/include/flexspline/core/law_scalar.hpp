#pragma once

#include <array>
#include <span>

#include "flexspline/core/error.hpp"
#include "flexspline/core/law.hpp"
#include "flexspline/core/scalar.hpp"

namespace flexspline {

/// Most coefficients of a law that is evaluated with derivatives.
inline constexpr std::size_t kMostCoefficients = 128;

// A law evaluated to first order in its argument and its coefficients. The real parts of the
// coefficients must be those the law was made with. Second derivatives are not carried.

inline double evaluate(const Law& law, double x, std::span<const double>) { return law.value(x); }

inline Complex evaluate(const Law& law, const Complex& x, std::span<const Complex> coefficients) {
  double imaginary = x.imag() == 0.0 ? 0.0 : law.slope(x.real()) * x.imag();
  bool moved = false;
  for (const Complex& c : coefficients) moved = moved || c.imag() != 0.0;
  if (moved) {
    expects(coefficients.size() <= kMostCoefficients, "a law has at most 128 coefficients");
    std::array<double, kMostCoefficients> gradient{};
    law.gradient(x.real(), std::span(gradient).first(coefficients.size()));
    for (std::size_t k = 0; k < coefficients.size(); ++k) {
      imaginary += gradient[k] * coefficients[k].imag();
    }
  }
  return {law.value(x.real()), imaginary};
}

/// value's derivatives += weight * those of d.
inline void add_derivatives(Dual& value, double weight, const Dual& d) {
  if (d.derivatives().size() == 0) return;
  if (value.derivatives().size() == 0) {
    value.derivatives() = weight * d.derivatives();
  } else {
    value.derivatives() += weight * d.derivatives();
  }
}

inline Dual evaluate(const Law& law, const Dual& x, std::span<const Dual> coefficients) {
  Dual y(law.value(x.value()));
  if (x.derivatives().size() > 0) add_derivatives(y, law.slope(x.value()), x);
  bool moved = false;
  for (const Dual& c : coefficients) moved = moved || c.derivatives().size() > 0;
  if (!moved) return y;
  expects(coefficients.size() <= kMostCoefficients, "a law has at most 128 coefficients");
  std::array<double, kMostCoefficients> gradient{};
  law.gradient(x.value(), std::span(gradient).first(coefficients.size()));
  for (std::size_t k = 0; k < coefficients.size(); ++k) {
    add_derivatives(y, gradient[k], coefficients[k]);
  }
  return y;
}

}  // namespace flexspline
