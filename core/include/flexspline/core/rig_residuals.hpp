#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "flexspline/core/drive_spec.hpp"
#include "flexspline/core/error.hpp"
#include "flexspline/core/recording.hpp"
#include "flexspline/core/resolution.hpp"

namespace flexspline {

/// The channels of a drive with smooth derivatives, at the same instants. Empty where not measured.
struct DriveChannels {
  std::vector<double> time;
  std::vector<double> motor_angle, motor_speed, motor_acceleration;
  std::vector<double> load_angle, load_speed, load_acceleration;
  std::vector<double> torsion, torsion_rate, torsion_acceleration;  ///< measured on a specimen
  std::vector<double> transmitted_torque;
  std::vector<double> motor_torque;
  /// rad/s: of what turns with w the smoothed motor angle and its derivatives keep the share
  /// 1/(1 + (w/motor_bandwidth)^6).
  double motor_bandwidth = std::numeric_limits<double>::infinity();
  /// Standard deviations by sample.
  std::vector<double> motor_angle_error, torsion_error;
  std::vector<double> motor_speed_error, torsion_rate_error;
  std::vector<double> motor_acceleration_error, load_acceleration_error;
  /// Accelerations that are smoothed further, with their standard deviations and bandwidths, rad/s;
  /// of an angle that is not recorded empty.
  struct Narrower {
    std::vector<double> motor, load, motor_error, load_error;
    double motor_bandwidth = std::numeric_limits<double>::infinity();
    double load_bandwidth = std::numeric_limits<double>::infinity();
  };
  std::vector<Narrower> narrower;
  std::vector<double> load_torque;  ///< beyond the pendulum's; empty for none
};

/// What one equation leaves over, or why it cannot be formed.
struct EquationResidual {
  std::vector<double> value;  ///< empty where the equation cannot be formed
  std::string absent;         ///< what is missing
};

/// The equations of a drive each on its own, so that a cause shows in one and not in the others.
struct DriveResiduals {
  /// tau_m - J1 theta_m'' - B1 theta_m' - tau_f - tau_s/N, eq. (5), Nm at the motor.
  EquationResidual motor;
  /// tau_s - J2 theta_l'' - B2 theta_l' - tau_L, eq. (6), Nm at the output.
  EquationResidual load;
  /// tau_s - f(phi) - g^-1(phi'/h(phi)), eq. (7), Nm at the output.
  EquationResidual torsion;
  /// N motor + load: the drive without what is transmitted, for rigs without a torque sensor.
  EquationResidual drive;
};

/// Each equation along the channels, with the drive's effects at their sites; effects on
/// instruments are not undone, so that they show.
/// Errors: a law or effect that cannot be made, channels of different lengths.
Result<DriveResiduals> residuals(Rig rig, const DriveSpec& drive, const DriveChannels& channels);

/// A recording's channels, angles smoothed by a penalised spline for their derivatives. On the
/// locked rig the load rests. current becomes motor torque by kt, duty_cycle by kt (V - ke
/// omega)/R. narrower: by what the bandwidths of further accelerations are divided. Errors: fewer
/// than 16 samples.
Result<DriveChannels> drive_channels(Rig rig, const DriveSpec& drive, const Recording& recording,
                                     Resolution resolution = Resolution::even,
                                     std::span<const double> narrower = {});

}  // namespace flexspline
