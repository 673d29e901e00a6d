#pragma once

#include <array>
#include <cstddef>

namespace flexspline {

/// Uniform cubic B-splines over [from, to] in the given number of intervals: intervals + 3 of them,
/// four of which are not zero at any point.
class CubicBasis {
 public:
  CubicBasis(double from, double to, std::size_t intervals);

  std::size_t size() const { return intervals_ + 3; }

  /// The four that are not zero at x: index of the first, and their values or derivatives in x.
  /// Outside [from, to] the polynomials of the nearest interval are continued.
  struct Local {
    std::size_t first;
    std::array<double, 4> value;
    std::array<double, 4> slope;
    std::array<double, 4> curvature;
  };
  Local at(double x) const;

 private:
  double from_;
  double width_;
  std::size_t intervals_;
};

}  // namespace flexspline
