#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace flexspline {

/// Integrals I_i(u) = int_0^u B_i of the clamped quadratic B-splines B_i on [0, 1] (I-splines up to
/// a factor; Ramsay 1988). Non-negative coefficients give a non-decreasing function; beyond u = 1
/// each continues with its slope at 1. There are knots + 3 of them. u >= 0, dimensionless.
class IntegratedBasis {
 public:
  /// Interior knots, increasing, on (0, 1).
  explicit IntegratedBasis(std::span<const double> interior_knots);

  std::size_t size() const { return size_; }
  std::span<const double> breakpoints() const { return breakpoints_; }
  /// Interval that holds u; the last one for u >= 1.
  std::size_t interval(double u) const;

  /// I_i(u) for every i.
  void values(double u, std::span<double> out) const;
  /// B_i(u) for every i.
  void slopes(double u, std::span<double> out) const;

  /// Cubic a0 + a1 d + a2 d^2 + a3 d^3, d = u - left end, of sum_i c_i I_i on every interval, and
  /// after the last the linear tail.
  std::vector<std::array<double, 4>> pieces(std::span<const double> coefficients) const;

 private:
  struct Quadratic {  // B_i on one interval: q0 + q1 d + q2 d^2
    double q0, q1, q2;
    double half_q1, third_q2;  // of its integral
  };
  const Quadratic& piece(std::size_t i, std::size_t interval) const {
    return table_[i * intervals_ + interval];
  }

  /// Of the quadratic splines three are not 0 on an interval, from that of its own number on.
  static constexpr std::size_t kActive = 3;

  std::vector<double> breakpoints_;
  std::vector<double> starts_;  ///< I_i at the left end of each interval, interval by interval
  std::size_t size_ = 0;
  std::size_t intervals_ = 0;
  std::vector<Quadratic> table_;
};

}  // namespace flexspline
