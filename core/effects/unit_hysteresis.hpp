#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "flexspline/core/scalar.hpp"

namespace flexspline {

/// dy/dx = 1 - sgn(y) |y|^n: Bouc and Wen's law of unit height and slip length along rising x.
template <class S>
S unit_hysteresis_slope(const S& y, const S& n) {
  const S power = positive_power(magnitude(y), n);
  return where_negative(y, S(1.0 + power), S(1.0 - power));
}

/// x since y was 0, by its series in |y|^n, for |y|^n of 0.05 or less.
template <class S>
S unit_hysteresis_path(const S& y, const S& n) {
  const S power = positive_power(magnitude(y), n);
  const S ratio = real_part(y) < 0.0 ? S(-power) : power;
  S sum(0.0);
  for (double k = 14.0; k > 0.0; --k) sum = ratio * (1.0 / (k * n + 1.0) + sum);
  return y * (1.0 + sum);
}

/// Where that series takes y, by Newton.
template <class S>
S from_unit_hysteresis_path(const S& path, const S& n) {
  const double wanted = real_part(path);
  const double exponent = real_part(n);
  double y = wanted;
  for (int k = 0; k < 50; ++k) {
    const double off = unit_hysteresis_path(y, exponent) - wanted;
    const double step = off * unit_hysteresis_slope(y, exponent);
    y -= step;
    if (std::abs(step) <= 1e-16 * std::abs(y)) break;
  }
  const S root = y;
  return root - (unit_hysteresis_path(root, n) - path) * unit_hysteresis_slope(root, n);
}

/// y after a step of at most `left`, which it shortens by what it took: the Taylor series, its
/// terms by w = |y|^n, y w' = n w y'. It takes as many terms as it needs and as long a step as they
/// converge over.
template <class S>
S unit_hysteresis_step(const S& y, S& left, const S& n) {
  constexpr std::size_t kTerms = 20;
  constexpr double kSmall = 1e-17;
  const double sign = real_part(y) < 0.0 ? 1.0 : -1.0;
  std::array<S, kTerms + 1> c;
  std::array<S, kTerms + 1> w;
  c[0] = y;
  w[0] = positive_power(magnitude(y), n);
  double h = real_part(left);
  std::size_t last = 0;
  double power = h;
  for (std::size_t k = 1; k <= kTerms; ++k) {
    c[k] = S((k == 1 ? 1.0 + sign * w[0] : sign * w[k - 1]) / static_cast<double>(k));
    S sum(0.0);
    for (std::size_t j = 1; j <= k; ++j) {
      const double of_w = static_cast<double>(k - j);
      sum += S(S(static_cast<double>(j) * n - of_w) * (c[j] * w[k - j]));
    }
    w[k] = S(sum / S(static_cast<double>(k) * y));
    last = k;
    const bool done =
        std::abs(real_part(c[k])) * power < kSmall && std::abs(real_part(w[k])) * power < kSmall;
    if (done) break;
    power *= h;
  }
  if (last == kTerms) {
    const double tail = std::max(std::abs(real_part(c[kTerms])), 1e-300);
    h = std::min(h, std::pow(kSmall / tail, 1.0 / static_cast<double>(kTerms)));
  }
  const S step = h < real_part(left) ? S(h) : left;
  S moved(0.0);
  for (std::size_t k = last; k > 0; --k) moved = step * (c[k] + moved);
  left = left - step;
  return y + moved;
}

/// y after x has risen by `distance` >= 0: exact to rounding for 0.2 <= n <= 5. Around y = 0, where
/// |y|^n has no Taylor series, by the law's own.
template <class S>
S along_unit_hysteresis(S y, S distance, const S& n) {
  const double near = std::pow(0.05, 1.0 / real_part(n));
  for (int k = 0; k < 10000 && real_part(distance) > 0.0; ++k) {
    if (real_part(y) >= 1.0 - 1e-15) return limited(y, S(1.0));
    if (real_part(y) >= near || real_part(y) < -near) {
      y = unit_hysteresis_step(y, distance, n);
      continue;
    }
    const S start = unit_hysteresis_path(y, n);
    const S whole = start + distance;
    const S edge = unit_hysteresis_path(S(near), n);
    if (real_part(whole) <= real_part(edge)) return from_unit_hysteresis_path(whole, n);
    distance = whole - edge;
    y = S(near);
  }
  return y;
}

}  // namespace flexspline
