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

inline Dual evaluate(const Law& law, const Dual& x, std::span<const Dual> coefficients) {
  const double value = law.value(x.value());
  Dual y = x.directions() > 0 ? Dual::chain(x, value, law.slope(x.value())) : Dual(value);
  bool moved = false;
  for (const Dual& c : coefficients) moved = moved || c.directions() > 0;
  if (!moved) return y;
  expects(coefficients.size() <= kMostCoefficients, "a law has at most 128 coefficients");
  std::array<double, kMostCoefficients> gradient{};
  law.gradient(x.value(), std::span(gradient).first(coefficients.size()));
  for (std::size_t k = 0; k < coefficients.size(); ++k) {
    y = Dual::chain(y, coefficients[k], value, 1.0, gradient[k]);
  }
  return y;
}

}  // namespace flexspline
