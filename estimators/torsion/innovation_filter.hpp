#pragma once

#include <span>
#include <vector>

#include "torsion/prepared_record.hpp"

namespace flexspline::estimators {

/// Turns residuals of a simulated torsion into independent ones of unit variance. The torque that
/// drives eq. (3) is off by its own noise and by what the noise of the motion is worth in torque
/// (effort_sigma), and the gear remembers: delta phi' = decay delta phi + gain delta tau; the
/// reconstructed motion adds its error. The innovations of the scalar
/// Kalman filter of that equation are independent (Schweppe 1965), so their least squares is
/// maximum likelihood; plain least squares of phi would overweight the soft middle of the spring,
/// where a little torque is much torsion. decay in 1/s, gain in rad/s per Nm, at the record's
/// instants.
class InnovationFilter {
 public:
  InnovationFilter(const PreparedRecord& record, std::span<const double> decay,
                   std::span<const double> gain);

  /// In place: a residual a row of the record, then (where given) Jacobian rows of `width`.
  void whiten(std::span<double> residual, std::span<double> jacobian, std::size_t width) const;

 private:
  struct Step {
    double transition;  // of the deviation since the last row
    double update;      // share of an innovation that goes into the deviation
    double weight;      // 1 / standard deviation of the innovation
  };
  std::vector<Step> steps_;
};

}  // namespace flexspline::estimators
