#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "flexspline/core/ode_system.hpp"

namespace flexspline {

/// Derivatives of a system by its own duals, kMostDirections at a time.
class SystemDuals {
 public:
  SystemDuals(const OdeSystem& system, std::span<const double> p);

  std::size_t states() const { return states_.size(); }
  std::size_t parameters() const { return parameters_.size(); }
  void rate(double t, const double* y, double* ydot) const;
  /// dF/dy.
  void jacobian(double t, const double* y, Eigen::Map<Eigen::MatrixXd> out);
  /// (F, dF/dy S + dF/dp) for z = (y, S), columns of length states().
  void sensitivity_rate(double t, const double* z, double* zdot);
  /// dF/dp by columns.
  void parameter_jacobian(double t, const double* y, Eigen::Map<Eigen::MatrixXd> out);

 private:
  void load(const double* y);
  // The columns of `out` from `first` on: the rates' derivatives along the duals' directions.
  void differentiate(double t, std::size_t first, Eigen::Map<Eigen::MatrixXd> out,
                     std::size_t width);

  const OdeSystem& system_;
  std::span<const double> p_;
  std::vector<Dual> states_;
  std::vector<Dual> parameters_;
  std::vector<Dual> rates_;
};

}  // namespace flexspline
