#pragma once

#include <array>
#include <span>
#include <vector>

#include "flexspline/core/integrated_basis.hpp"
#include "flexspline/core/law.hpp"

namespace flexspline {

/// y(x) = sum_i a_i I_i(x/s) for x >= 0 and -sum_i b_i I_i(-x/s) for x < 0, with I_i the integrated
/// quadratic B-splines and s the scale. All a_i, b_i > 0 make it increasing everywhere; it is zero
/// at zero and linear beyond |x| = s. b = a (odd) when only one set of coefficients is given.
/// Coefficients in the unit of y, knots on (0, 1).
class MonotoneSpline final : public Law {
 public:
  explicit MonotoneSpline(LawSpec spec);

  double value(double x) const override;
  double slope(double x) const override;
  void gradient(double x, std::span<double> out) const override;
  const LawSpec& spec() const override { return spec_; }

  /// x with y(x) = y. All slopes must be positive.
  double inverse(double y) const;

  bool odd() const { return odd_; }

 private:
  struct Side {
    std::vector<std::array<double, 4>> pieces;
  };
  double side_value(const Side& side, double u) const;
  double side_slope(const Side& side, double u) const;
  double side_inverse(const Side& side, double y) const;

  LawSpec spec_;
  IntegratedBasis basis_;
  bool odd_;
  std::array<Side, 2> sides_;
};

}  // namespace flexspline
