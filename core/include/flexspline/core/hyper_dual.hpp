#pragma once

#include <cmath>

namespace flexspline {

/// A number with its derivatives along two directions and the mixed second derivative: exact second
/// derivatives without steps. f(x + e1 a + e2 b) with e1^2 = e2^2 = 0 and e1 e2 kept.
struct HyperDual {
  double value = 0.0;
  double first = 0.0;   ///< along the first direction
  double second = 0.0;  ///< along the second
  double mixed = 0.0;   ///< second derivative along both

  HyperDual() = default;
  HyperDual(double x) : value(x) {}  // NOLINT: numbers are constants
  HyperDual(double x, double along_first, double along_second)
      : value(x), first(along_first), second(along_second) {}

  HyperDual& operator+=(const HyperDual& b) { return *this = *this + b; }
  HyperDual& operator-=(const HyperDual& b) { return *this = *this - b; }
  HyperDual& operator*=(const HyperDual& b) { return *this = *this * b; }
  HyperDual& operator/=(const HyperDual& b) { return *this = *this / b; }

  /// f(a) from f, f' and f'' at a's value.
  static HyperDual chain(const HyperDual& a, double f, double slope, double curvature) {
    HyperDual r(f, slope * a.first, slope * a.second);
    r.mixed = slope * a.mixed + curvature * a.first * a.second;
    return r;
  }

  friend HyperDual operator+(const HyperDual& a, const HyperDual& b) {
    HyperDual r(a.value + b.value, a.first + b.first, a.second + b.second);
    r.mixed = a.mixed + b.mixed;
    return r;
  }
  friend HyperDual operator-(const HyperDual& a) {
    HyperDual r(-a.value, -a.first, -a.second);
    r.mixed = -a.mixed;
    return r;
  }
  friend HyperDual operator-(const HyperDual& a, const HyperDual& b) { return a + (-b); }
  friend HyperDual operator*(const HyperDual& a, const HyperDual& b) {
    HyperDual r(a.value * b.value, a.first * b.value + a.value * b.first,
                a.second * b.value + a.value * b.second);
    r.mixed = a.mixed * b.value + a.first * b.second + a.second * b.first + a.value * b.mixed;
    return r;
  }
  friend HyperDual operator/(const HyperDual& a, const HyperDual& b) {
    const double inverse = 1.0 / b.value;
    return a * chain(b, inverse, -inverse * inverse, 2.0 * inverse * inverse * inverse);
  }
};

inline double real_part(const HyperDual& x) { return x.value; }

inline HyperDual exp(const HyperDual& x) {
  const double f = std::exp(x.value);
  return HyperDual::chain(x, f, f, f);
}

inline HyperDual log(const HyperDual& x) {
  return HyperDual::chain(x, std::log(x.value), 1.0 / x.value, -1.0 / (x.value * x.value));
}

inline HyperDual sqrt(const HyperDual& x) {
  const double f = std::sqrt(x.value);
  return HyperDual::chain(x, f, 0.5 / f, -0.25 / (f * x.value));
}

inline HyperDual sin(const HyperDual& x) {
  return HyperDual::chain(x, std::sin(x.value), std::cos(x.value), -std::sin(x.value));
}

inline HyperDual cos(const HyperDual& x) {
  return HyperDual::chain(x, std::cos(x.value), -std::sin(x.value), -std::cos(x.value));
}

inline HyperDual tanh(const HyperDual& x) {
  const double f = std::tanh(x.value);
  const double slope = 1.0 - f * f;
  return HyperDual::chain(x, f, slope, -2.0 * f * slope);
}

inline HyperDual atan(const HyperDual& x) {
  const double slope = 1.0 / (1.0 + x.value * x.value);
  return HyperDual::chain(x, std::atan(x.value), slope, -2.0 * x.value * slope * slope);
}

inline HyperDual pow(const HyperDual& x, double n) {
  const double curvature = n * (n - 1.0) * std::pow(x.value, n - 2.0);
  return HyperDual::chain(x, std::pow(x.value, n), n * std::pow(x.value, n - 1.0), curvature);
}

}  // namespace flexspline
