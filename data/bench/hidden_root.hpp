#pragma once

#include <cmath>
#include <limits>

namespace flexspline::data {

/// x with f(x) = 0 for an f that rises through it: a bracket grown around the guess, then Newton
/// steps by difference quotient, each replaced by bisection where it leaves the bracket.
/// NaN where no change of sign is found within 60 doublings of the width.
template <class Function>
double rising_root(const Function& f, double guess, double width, double tolerance) {
  double low = guess;
  double high = guess;
  double step = width;
  const double at_guess = f(guess);
  if (at_guess == 0.0) return guess;
  for (int k = 0; k < 60; ++k, step *= 2.0) {
    double& end = at_guess < 0.0 ? high : low;
    double& other = at_guess < 0.0 ? low : high;
    other = end;
    end += at_guess < 0.0 ? step : -step;
    if (f(end) * at_guess <= 0.0) break;
    if (k == 59) return std::numeric_limits<double>::quiet_NaN();
  }
  double x = 0.5 * (low + high);
  for (int k = 0; k < 200; ++k) {
    const double value = f(x);
    (value < 0.0 ? low : high) = x;
    if (value == 0.0 || high - low <= tolerance) break;
    const double nudge = 1e-4 * (high - low) + tolerance;
    const double slope = (f(x + nudge) - value) / nudge;
    double next = x - value / slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const bool settled = std::abs(next - x) <= tolerance;
    x = next;
    if (settled) break;
  }
  return x;
}

}  // namespace flexspline::data
