#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace flexspline::reports {

/// Smallest and largest of the finite values it was given.
struct Extent {
  double lower = HUGE_VAL;
  double upper = -HUGE_VAL;

  void take(double value) {
    if (!std::isfinite(value)) return;
    lower = std::min(lower, value);
    upper = std::max(upper, value);
  }
  void take(const std::vector<double>& values) {
    for (const double value : values) take(value);
  }

  bool empty() const { return lower > upper; }
  /// Largest absolute value.
  double reach() const { return std::max(std::abs(lower), std::abs(upper)); }
};

}  // namespace flexspline::reports
