#pragma once

#include <array>

#include <Eigen/Core>

#include "flexspline/core/cubic_basis.hpp"

namespace flexspline::estimators {

/// A cubic spline with many even intervals over a coordinate u(x) that may be finer about zero,
/// less its value at x = 0: the gauge of f, g^-1 and ln h.
class RichSpline {
 public:
  /// fine: x below which the coordinate is logarithmic; 0: even everywhere.
  RichSpline(double from, double to, std::size_t intervals, double fine);

  /// Weights of coefficients first to first + 3 in the value, before the gauge, and in the slope.
  struct Local {
    Eigen::Index first = 0;
    std::array<double, 4> value{}, slope{};
  };

  Eigen::Index size() const { return static_cast<Eigen::Index>(basis_.size()); }
  Local at(double x) const;
  /// Of a spline with these coefficients.
  double value(const Local& at, const Eigen::Ref<const Eigen::VectorXd>& coefficients) const;
  static double slope(const Local& at, const Eigen::Ref<const Eigen::VectorXd>& coefficients);
  /// Adds the weights of all coefficients in `weight` values.
  void add_value(const Local& at, double weight, Eigen::Ref<Eigen::RowVectorXd> row) const;
  /// Weights of the coefficients in the value and the slope at x, straight on beyond the ends.
  void value(double x, Eigen::Ref<Eigen::RowVectorXd> row) const;
  void slope(double x, Eigen::Ref<Eigen::RowVectorXd> row) const;
  /// Weights of coefficients k, k + 1 and k + 2 in what is normal with one variance where the
  /// second derivative is white noise: the second divided difference at the centres of their
  /// functions, by the root of the distance between these; 1, -2, 1 where all intervals are alike.
  std::array<double, 3> bend(Eigen::Index k) const;
  /// How far x lies beyond the ends, in mean intervals.
  double beyond(double x) const;

 private:
  double coordinate(double x) const;
  double coordinate_slope(double x) const;
  double at_coordinate(double u) const;

  double low_, high_, fine_, scale_, from_, to_, width_;
  CubicBasis basis_;
  Local zero_;
};

}  // namespace flexspline::estimators
