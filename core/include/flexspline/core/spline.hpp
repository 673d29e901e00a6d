#pragma once

#include <array>
#include <span>
#include <vector>

namespace flexspline {

/// Cubic spline through samples (Catmull-Rom slopes by three-point formulas; C1, third order), held
/// constant beyond the ends. O(1) look-up when called with increasing arguments.
class Spline {
 public:
  Spline(std::span<const double> x, std::span<const double> y);

  double value(double x) const;
  double slope(double x) const;

 private:
  std::size_t interval(double x) const;

  std::vector<double> x_;
  std::vector<double> y_;
  std::vector<double> slope_;
  mutable std::size_t hint_ = 0;
};

}  // namespace flexspline
