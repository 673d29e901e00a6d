#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace flexspline::estimators::certified {

/// A number with its exact derivatives by N parameters.
template <std::size_t N>
struct Dual {
  double value = 0.0;
  std::array<double, N> slope{};

  Dual() = default;
  Dual(double constant) : value(constant) {}  // NOLINT: constants mix with duals

  /// f(x) with df/dx.
  Dual chain(double f, double derivative) const {
    Dual result(f);
    for (std::size_t k = 0; k < N; ++k) result.slope[k] = derivative * slope[k];
    return result;
  }

  Dual operator-() const { return chain(-value, -1.0); }

  friend Dual operator+(const Dual& a, const Dual& b) {
    return join(a, b, a.value + b.value, 1, 1);
  }
  friend Dual operator-(const Dual& a, const Dual& b) {
    return join(a, b, a.value - b.value, 1, -1);
  }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return join(a, b, a.value * b.value, b.value, a.value);
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const double quotient = a.value / b.value;
    return join(a, b, quotient, 1.0 / b.value, -quotient / b.value);
  }

 private:
  static Dual join(const Dual& a, const Dual& b, double f, double by_a, double by_b) {
    Dual result(f);
    for (std::size_t k = 0; k < N; ++k) result.slope[k] = by_a * a.slope[k] + by_b * b.slope[k];
    return result;
  }
};

template <std::size_t N>
Dual<N> exp(const Dual<N>& x) {
  const double value = std::exp(x.value);
  return x.chain(value, value);
}
template <std::size_t N>
Dual<N> log(const Dual<N>& x) {
  return x.chain(std::log(x.value), 1.0 / x.value);
}
template <std::size_t N>
Dual<N> sqrt(const Dual<N>& x) {
  const double value = std::sqrt(x.value);
  return x.chain(value, 0.5 / value);
}
template <std::size_t N>
Dual<N> sin(const Dual<N>& x) {
  return x.chain(std::sin(x.value), std::cos(x.value));
}
template <std::size_t N>
Dual<N> cos(const Dual<N>& x) {
  return x.chain(std::cos(x.value), -std::sin(x.value));
}
template <std::size_t N>
Dual<N> atan(const Dual<N>& x) {
  return x.chain(std::atan(x.value), 1.0 / (1.0 + x.value * x.value));
}
template <std::size_t N>
Dual<N> pow(const Dual<N>& x, double n) {
  return x.chain(std::pow(x.value, n), n * std::pow(x.value, n - 1.0));
}
/// x^n for x > 0.
template <std::size_t N>
Dual<N> pow(const Dual<N>& x, const Dual<N>& n) {
  return exp(n * log(x));
}
template <class S>
S square(const S& x) {
  return x * x;
}

}  // namespace flexspline::estimators::certified
