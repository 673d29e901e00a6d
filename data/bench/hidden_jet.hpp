#pragma once

#include <cmath>

namespace flexspline::data {

/// A value with its first two derivatives in time.
struct Jet {
  double value = 0.0;
  double first = 0.0;
  double second = 0.0;
};

inline Jet operator+(const Jet& a, const Jet& b) {
  return {a.value + b.value, a.first + b.first, a.second + b.second};
}
inline Jet operator*(double c, const Jet& a) { return {c * a.value, c * a.first, c * a.second}; }
inline Jet operator*(const Jet& a, const Jet& b) {
  return {a.value * b.value, a.first * b.value + a.value * b.first,
          a.second * b.value + 2.0 * a.first * b.first + a.value * b.second};
}

/// sin(rate t + phase).
inline Jet sine(double rate, double phase, double t) {
  const double s = std::sin(rate * t + phase);
  return {s, rate * std::cos(rate * t + phase), -rate * rate * s};
}

/// From 0 to 1 over t in [0, width] with three continuous derivatives.
inline Jet soft_step(double t, double width) {
  const double u = t / width;
  if (u <= 0.0) return {};
  if (u >= 1.0) return {1.0, 0.0, 0.0};
  const double rest = 1.0 - u;
  const double u3 = u * u * u;
  return {u3 * u * (35.0 + u * (-84.0 + u * (70.0 - 20.0 * u))),
          140.0 * u3 * rest * rest * rest / width,
          420.0 * u * u * rest * rest * (1.0 - 2.0 * u) / (width * width)};
}

/// The integral of soft_step from rest.
inline Jet soft_ramp(double t, double width) {
  const double u = t / width;
  if (u <= 0.0) return {};
  const Jet step = soft_step(t, width);
  const double u5 = u * u * u * u * u;
  const double area = u >= 1.0 ? u - 0.5 : u5 * (7.0 + u * (-14.0 + u * (10.0 - 2.5 * u)));
  return {width * area, step.value, step.first};
}

}  // namespace flexspline::data
