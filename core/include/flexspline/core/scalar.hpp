#pragma once

#include <cmath>
#include <complex>

#include "flexspline/core/dual.hpp"
#include "flexspline/core/traced.hpp"

namespace flexspline {

/// For the complex step, which checks derivatives to rounding.
using Complex = std::complex<double>;

// Laws are templates over the scalar. They branch on real parts only, and take absolute values and
// signs from here, because |z| of a complex number is not analytic.

inline double real_part(double x) { return x; }
inline double real_part(const Complex& x) { return x.real(); }

/// |x|; its derivative at 0 is that from the right.
template <class S>
S magnitude(const S& x) {
  return real_part(x) < 0.0 ? -x : x;
}

/// then where x < 0, otherwise elsewhere: a branch for laws that are also traced.
template <class S>
S where_negative(const S& x, const S& then, const S& otherwise) {
  return real_part(x) < 0.0 ? then : otherwise;
}

template <class S>
S square(const S& x) {
  return x * x;
}

/// tanh(x / width): a sign that is smooth over `width`.
template <class S>
S smooth_sign(const S& x, const S& width) {
  using std::tanh;
  return tanh(x / width);
}

/// sqrt(x^2 + width^2) - width: a magnitude that is smooth over `width` and 0 at 0.
template <class S>
S smooth_magnitude(const S& x, const S& width) {
  using std::sqrt;
  return sqrt(square(x) + square(width)) - width;
}

/// x^n for x > 0 and 0 at x <= 0; n may be a parameter.
template <class S>
S positive_power(const S& x, const S& n) {
  using std::exp;
  using std::log;
  if (!(real_part(x) > 0.0)) return 0.0;
  return exp(n * log(x));
}

/// x limited to [-bound, bound].
template <class S>
S limited(const S& x, const S& bound) {
  if (real_part(x) > real_part(bound)) return bound;
  if (real_part(x) < -real_part(bound)) return -bound;
  return x;
}

/// Rate of a stop operator (elastic, perfectly plastic): that of its input unless it yields.
template <class S>
S stop_rate(const S& stop, const S& input_rate, const S& yield) {
  const double along = real_part(input_rate) < 0.0 ? -real_part(stop) : real_part(stop);
  return along >= real_part(yield) && real_part(input_rate) != 0.0 ? S(0.0) : input_rate;
}

/// A step from 0 to 1 that is smooth over `width`: (1 + x / sqrt(x^2 + width^2)) / 2, exact in both
/// tails; 1 % off at 5 widths.
template <class S>
S smooth_step(const S& x, const S& width) {
  using std::sqrt;
  const S root = sqrt(square(x) + square(width));
  const S tail = square(width) / (2.0 * root * (root + magnitude(x)));
  return real_part(x) < 0.0 ? tail : 1.0 - tail;
}

/// exp(-(x / width)^2): the share of a Stribeck peak that is left at speed x.
template <class S>
S bell(const S& x, const S& width) {
  using std::exp;
  return exp(-square(x / width));
}

/// 1 - exp(-x) for x >= 0, to rounding at small x too: the share of a relaxation done.
template <class S>
S relaxed(const S& x) {
  using std::tanh;
  const S half = tanh(0.5 * x);
  return 2.0 * half / (1.0 + half);
}

/// (1 - exp(-x)) / x for x >= 0, 1 at 0: the mean over a step of what a relaxation has left. A
/// polynomial near 0, where the quotient's derivative would cancel.
template <class S>
S mean_left(const S& x) {
  if (std::abs(real_part(x)) > 0.01) return relaxed(x) / x;
  S sum = 1.0;
  for (double n = 7.0; n > 1.0; n -= 1.0) sum = 1.0 - x / n * sum;
  return sum;
}

}  // namespace flexspline
