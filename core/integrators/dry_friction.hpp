#pragma once

#include <cmath>

#include "flexspline/core/stick_slip.hpp"
#include "integrators/cvodes_run.hpp"

namespace flexspline {

/// Level of friction while slipping at a speed.
inline double slip_level(const DryFrictionDrive& drive, double v) {
  const double excess = drive.static_level - drive.sliding_level;
  if (excess == 0.0 || drive.stribeck_speed == 0.0) return drive.sliding_level;
  const double u = v / drive.stribeck_speed;
  return drive.sliding_level + excess * std::exp(-u * u);
}

/// Its derivative in v.
inline double slip_level_slope(const DryFrictionDrive& drive, double v) {
  if (drive.stribeck_speed == 0.0) return 0.0;
  return -2.0 * v / (drive.stribeck_speed * drive.stribeck_speed) *
         (slip_level(drive, v) - drive.sliding_level);
}

/// The Jacobian of (x, v) for a friction with that derivative in v.
inline void fill_jacobian(const DryFrictionDrive& drive, double t, double x, double friction_slope,
                          Eigen::Map<Eigen::MatrixXd>& out) {
  out(0, 0) = 0.0;
  out(0, 1) = 1.0;
  out(1, 0) = drive.effort_slope ? drive.effort_slope(t, x) / drive.inertia : 0.0;
  out(1, 1) = -(drive.viscous + friction_slope) / drive.inertia;
}

/// Errors: bad_data for a drive outside its ranges or times that do not increase.
Result<void> check(const DryFrictionDrive& drive, std::span<const double> times);

inline CvodesAccuracy accuracy_of(const StickSlipSettings& settings) {
  return {settings.relative_tolerance,
          {settings.position_tolerance, settings.speed_tolerance},
          settings.max_steps};
}

}  // namespace flexspline
