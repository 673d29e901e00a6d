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

}  // namespace flexspline
