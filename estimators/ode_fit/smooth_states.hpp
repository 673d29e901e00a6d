#pragma once

#include <vector>

#include <Eigen/Core>

namespace flexspline::estimators {

/// A cubic B-spline on even knots with a penalty on its curvature (Eilers and Marx, 1996), whose
/// weight is chosen by generalised cross-validation (Craven and Wahba, 1979).
class SmoothCurve {
 public:
  /// Weights multiply squared residuals. Times increase.
  SmoothCurve(const std::vector<double>& time, const std::vector<double>& value,
              const std::vector<double>& weight);

  double value(double t) const;
  double slope(double t) const;

 private:
  // The four splines that are not zero at t, with their first.
  struct Local {
    Eigen::Index first;
    Eigen::Vector4d value;
    Eigen::Vector4d slope;
  };
  Local local(double t) const;

  double from_ = 0.0;
  double step_ = 1.0;
  Eigen::Index intervals_ = 1;
  Eigen::VectorXd coefficient_;
};

}  // namespace flexspline::estimators
