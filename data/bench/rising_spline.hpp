#pragma once

#include <array>
#include <cstddef>

#include <Eigen/Core>

namespace flexspline::data {

/// An odd function of x whose slope on [0, 1] is a quadratic B-spline with knots at 1/4, 1/2, 3/4
/// and which goes on straight beyond 1. Coefficients >= 0 make it rise everywhere.
class RisingSpline {
 public:
  static constexpr std::size_t kSize = 6;

  /// The integrals from 0 to x of the six splines.
  static std::array<double, kSize> basis(double x);

  explicit RisingSpline(const Eigen::VectorXd& coefficients) : coefficients_(coefficients) {}
  double operator()(double x) const;

 private:
  Eigen::VectorXd coefficients_;
};

}  // namespace flexspline::data
