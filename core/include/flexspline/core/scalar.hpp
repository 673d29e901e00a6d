#pragma once

#include <cmath>
#include <complex>

#include <Eigen/Core>
#include <unsupported/Eigen/AutoDiff>

namespace flexspline {

/// Most directions that a Dual differentiates in.
inline constexpr int kMostDirections = 32;

/// A number with its gradient, for derivatives by the law itself. No heap.
using Dual = Eigen::AutoDiffScalar<Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostDirections, 1>>;
/// For the complex step, which checks derivatives to rounding.
using Complex = std::complex<double>;

// Laws are templates over the scalar. They branch on real parts only, and take absolute values and
// signs from here, because |z| of a complex number is not analytic.

inline double real_part(double x) { return x; }
inline double real_part(const Complex& x) { return x.real(); }
inline double real_part(const Dual& x) { return x.value(); }

/// |x|; its derivative at 0 is that from the right.
template <class S>
S magnitude(const S& x) {
  return real_part(x) < 0.0 ? S(-x) : x;
}

/// tanh(x / width): a sign that is smooth over `width`.
template <class S>
S smooth_sign(const S& x, const S& width) {
  using std::tanh;
  return S(tanh(S(x / width)));
}

/// sqrt(x^2 + width^2) - width: a magnitude that is smooth over `width` and 0 at 0.
template <class S>
S smooth_magnitude(const S& x, const S& width) {
  using std::sqrt;
  return S(S(sqrt(S(x * x + width * width))) - width);
}

/// x^n for x > 0 and 0 at x <= 0; n may be a parameter.
template <class S>
S positive_power(const S& x, const S& n) {
  using std::exp;
  using std::log;
  if (!(real_part(x) > 0.0)) return S(0.0);
  return S(exp(S(n * S(log(x)))));
}

/// x limited to [-bound, bound].
template <class S>
S limited(const S& x, const S& bound) {
  if (real_part(x) > real_part(bound)) return bound;
  if (real_part(x) < -real_part(bound)) return S(-bound);
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
  const S root(sqrt(S(x * x + width * width)));
  const S tail(S(width * width) / S(S(2.0 * root) * S(root + magnitude(x))));
  return real_part(x) < 0.0 ? tail : S(1.0 - tail);
}

/// exp(-(x / width)^2): the share of a Stribeck peak that is left at speed x.
template <class S>
S bell(const S& x, const S& width) {
  using std::exp;
  const S ratio(x / width);
  return S(exp(S(-ratio * ratio)));
}

/// 1 - exp(-x) for x >= 0, to rounding at small x too: the share of a relaxation done.
template <class S>
S relaxed(const S& x) {
  using std::tanh;
  const S half(tanh(S(0.5 * x)));
  return S(S(2.0 * half) / S(1.0 + half));
}

/// (1 - exp(-x)) / x for x >= 0, 1 at 0: the mean over a step of what a relaxation has left. A
/// polynomial near 0, where the quotient's derivative would cancel.
template <class S>
S mean_left(const S& x) {
  if (std::abs(real_part(x)) > 0.01) return S(relaxed(x) / x);
  S sum(1.0);
  for (double n = 7.0; n > 1.0; n -= 1.0) sum = S(1.0 - S(x / n) * sum);
  return sum;
}

}  // namespace flexspline
