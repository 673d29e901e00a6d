#pragma once

#include "flexspline/estimators/ode_fit.hpp"

namespace flexspline::estimators {

/// A loss of residuals in standard deviations.
struct RobustLoss {
  Loss kind = Loss::squared;
  double scale = 1.345;

  bool squared() const { return kind == Loss::squared; }
  /// Like r^2/2 where r is small.
  double value(double r) const;
  /// d value / d r.
  double influence(double r) const;
  /// d influence / d r; negative for large residuals where outliers lose their say.
  double curvature(double r) const;
};

/// A residual whose half square is the loss, with the factor of its derivatives.
struct LossResidual {
  double residual = 0.0;
  double slope = 1.0;
};
LossResidual as_residual(const RobustLoss& loss, double r);

}  // namespace flexspline::estimators
