#pragma once

#include "flexspline/core/forward_sensitivity.hpp"
#include "torque_driven/series.hpp"

namespace flexspline::estimators {

/// phi' of one recording with its derivatives by hand, all from one evaluation of the law.
class DrivenOde final : public ScalarOde {
 public:
  DrivenOde(const DrivenProblem& problem, const DrivenSeries& series, std::span<const double> p)
      : problem_(problem), series_(series), p_(p) {}

  std::size_t parameters() const override { return p_.size(); }
  double rate(double t, double x) const override;
  double jacobian(double t, double x) const override;
  double parameter_derivative(double t, double x, std::span<double> out) const override;

 private:
  double torque(double t) const;
  void evaluate(double t, double x) const;

  const DrivenProblem& problem_;
  const DrivenSeries& series_;
  std::span<const double> p_;
  // Of the last evaluation: CVODES asks for the derivatives at the point where it asked for the
  // rate.
  mutable std::size_t interval_ = 0;
  mutable double t_ = kNowhere;
  mutable double x_ = kNowhere;
  mutable double rate_ = 0.0;
  mutable double slope_ = 0.0;
  mutable double damping_ = 0.0;  // h u
  mutable double spring_ = 0.0;   // -h g' x
  mutable double u2_ = 0.0;
  static constexpr double kNowhere = 1e308;
};

}  // namespace flexspline::estimators
