#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "flexspline/core/error.hpp"

// GCC takes slopes beyond a dual's directions, which nothing reads, for ones that may be read.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"

namespace flexspline {

/// Most directions that a Dual differentiates in.
inline constexpr int kMostDirections = 32;

/// A number with its derivatives along some directions, exact to rounding; no heap. A constant has
/// no directions and mixes with any dual; two duals with directions have equally many. Every
/// operation is done at once: there are no expressions to outlive their operands or to disagree in
/// length.
class Dual {
 public:
  Dual(double constant = 0.0) : value_(constant) {}  // NOLINT: constants mix with duals
  /// A value whose derivatives along `directions` directions are 0.
  Dual(double value, int directions) : value_(value), directions_(directions) {
    expects(directions >= 0 && directions <= kMostDirections, "a dual has at most 32 directions");
    std::fill_n(slope_, directions, 0.0);
  }
  /// A value whose derivative along one of the directions is 1.
  Dual(double value, int directions, int along) : Dual(value, directions) { slope_[along] = 1.0; }

  Dual(const Dual& x) : value_(x.value_), directions_(x.directions_) {
    std::copy_n(x.slope_, directions_, slope_);
  }
  Dual& operator=(const Dual& x) {
    value_ = x.value_;
    directions_ = x.directions_;
    if (this != &x) std::copy_n(x.slope_, directions_, slope_);
    return *this;
  }
  ~Dual() = default;

  double value() const { return value_; }
  int directions() const { return directions_; }
  /// Derivatives, one a direction; empty for a constant.
  std::span<const double> slopes() const { return {slope_, static_cast<std::size_t>(directions_)}; }
  std::span<double> slopes() { return {slope_, static_cast<std::size_t>(directions_)}; }
  /// The derivative along direction k, 0 for a constant.
  double slope(int k) const { return directions_ > 0 ? slope_[k] : 0.0; }

  /// f(x) from f and f' at x's value.
  static Dual chain(const Dual& x, double f, double derivative) {
    Dual y(f);
    y.directions_ = x.directions_;
    for (int k = 0; k < x.directions_; ++k) y.slope_[k] = derivative * x.slope_[k];
    return y;
  }
  /// f(a, b) from f and its two derivatives at a's and b's values.
  static Dual chain(const Dual& a, const Dual& b, double f, double by_a, double by_b) {
    if (b.directions_ == 0) return chain(a, f, by_a);
    if (a.directions_ == 0) return chain(b, f, by_b);
    expects(a.directions_ == b.directions_, "duals differentiate along the same directions");
    Dual y(f);
    y.directions_ = a.directions_;
    for (int k = 0; k < y.directions_; ++k) y.slope_[k] = by_a * a.slope_[k] + by_b * b.slope_[k];
    return y;
  }

  friend Dual operator-(const Dual& a) { return chain(a, -a.value_, -1.0); }
  friend Dual operator+(const Dual& a, const Dual& b) {
    return chain(a, b, a.value_ + b.value_, 1.0, 1.0);
  }
  friend Dual operator-(const Dual& a, const Dual& b) {
    return chain(a, b, a.value_ - b.value_, 1.0, -1.0);
  }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return chain(a, b, a.value_ * b.value_, b.value_, a.value_);
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const double quotient = a.value_ / b.value_;
    return chain(a, b, quotient, 1.0 / b.value_, -quotient / b.value_);
  }

  Dual& operator+=(const Dual& b) { return *this = *this + b; }
  Dual& operator-=(const Dual& b) { return *this = *this - b; }
  Dual& operator*=(const Dual& b) { return *this = *this * b; }
  Dual& operator/=(const Dual& b) { return *this = *this / b; }

  friend double real_part(const Dual& x) { return x.value_; }

  friend Dual exp(const Dual& x) {
    const double f = std::exp(x.value_);
    return chain(x, f, f);
  }

  friend Dual log(const Dual& x) { return chain(x, std::log(x.value_), 1.0 / x.value_); }

  friend Dual sqrt(const Dual& x) {
    const double f = std::sqrt(x.value_);
    return chain(x, f, 0.5 / f);
  }

  friend Dual sin(const Dual& x) { return chain(x, std::sin(x.value_), std::cos(x.value_)); }

  friend Dual cos(const Dual& x) { return chain(x, std::cos(x.value_), -std::sin(x.value_)); }

  friend Dual tanh(const Dual& x) {
    const double c = std::cosh(x.value_);  // 1 - tanh^2 would cancel in the tails
    return chain(x, std::tanh(x.value_), 1.0 / (c * c));
  }

  friend Dual atan(const Dual& x) {
    return chain(x, std::atan(x.value_), 1.0 / (1.0 + x.value_ * x.value_));
  }

  friend Dual pow(const Dual& x, double n) {
    return chain(x, std::pow(x.value_, n), n * std::pow(x.value_, n - 1.0));
  }

  /// x^n for x > 0.
  friend Dual pow(const Dual& x, const Dual& n) { return exp(n * log(x)); }

 private:
  double value_;
  int directions_ = 0;
  double slope_[kMostDirections];  // set along directions_ only: a dual costs what it carries
};

}  // namespace flexspline

#pragma GCC diagnostic pop
