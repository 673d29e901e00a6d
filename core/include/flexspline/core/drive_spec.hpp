#pragma once

#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "flexspline/core/model_spec.hpp"
#include "flexspline/core/recording.hpp"

namespace flexspline {

/// Holds the motor at a reference angle r: tau_m = kp e + ki int e dt + kd e', e = r - theta_m,
/// limited to +-limit. Integration goes on at the limit.
struct PositionLoop {
  double proportional = 0.0;                               ///< Nm/rad
  double integral = 0.0;                                   ///< Nm/(rad s)
  double derivative = 0.0;                                 ///< Nm s/rad
  double limit = std::numeric_limits<double>::infinity();  ///< Nm
};

/// A whole drive as plain data, Dhaouadi and Ghorbel (2003), eqs. (4)-(14). SI; motor quantities at
/// the motor shaft, others at the output. 0 where a rig has no use for a constant.
struct DriveSpec {
  ModelSpec torsion;             ///< f, g^-1, h, and effects at any site
  double gear_ratio = 1.0;       ///< N; 1 on a specimen
  double motor_inertia = 0.0;    ///< J1, kg m2, with the wave generator
  double motor_viscous = 0.0;    ///< B1, Nm s/rad
  double motor_coulomb = 0.0;    ///< tau_f = c tanh(omega/w), Nm
  double coulomb_width = 0.5;    ///< w, rad/s at the motor
  double load_inertia = 0.0;     ///< J2, kg m2
  double load_viscous = 0.0;     ///< B2, Nm s/rad
  double load_mass = 0.0;        ///< m, kg: tau_L = m g l sin(theta_l), hanging down at 0
  double arm_length = 0.0;       ///< l, m
  double gravity = 9.80665;      ///< g, m/s2
  double torque_constant = 0.0;  ///< kt, Nm/A
  double resistance = 0.0;       ///< R, Ohm
  double inductance = 0.0;       ///< L, H
  double back_emf = 0.0;         ///< ke, V s/rad
  PositionLoop position_loop{};
};

/// Where a number of a model comes from: the data set states it; recordings were fitted; they
/// cannot tell it, so that its value is one of many; nobody asked.
enum class Origin { given, fitted, not_identifiable, assumed };

std::string_view name_of(Origin origin);
std::optional<Origin> find_origin(std::string_view name);

/// A drive and the bench it stands in: all that a simulation needs beside its inputs.
struct RigModel {
  Rig rig = Rig::specimen;
  DriveSpec drive;
  /// Of constants by their names, and of f, g_inverse and h; what is not there is not known.
  std::map<std::string, Origin, std::less<>> origin = {};
};

/// A constant of the drive that may be a parameter of a simulation.
struct DriveConstant {
  std::string_view name;
  std::string_view unit;
  double DriveSpec::*member;
  std::string_view says;
};

std::span<const DriveConstant> drive_constants();

/// The constants of these names, in this order. Every name must exist.
std::vector<DriveConstant> constants_named(std::initializer_list<std::string_view> names);

/// J = N^2 J1, eq. (12).
double reflected_inertia(const DriveSpec& drive);
/// B = N^2 B1, eq. (13).
double reflected_viscous(const DriveSpec& drive);
/// tau_n = N (tau_m - tau_f), eq. (14), with tau_f at that motor speed.
double reflected_torque(const DriveSpec& drive, double motor_torque, double motor_speed);

struct DriveParameter {
  std::string name;  ///< f[0], motor_inertia, presliding_hysteresis[1].stiffness
  std::string unit;
  double value;
};

/// The parameter vector of a drive: coefficients of f, g^-1, h, then the constants, then the
/// parameters of the effects in their order.
std::vector<DriveParameter> parameters_of(const DriveSpec& drive,
                                          std::span<const DriveConstant> constants);

/// The drive with another parameter vector of the same length.
DriveSpec with_parameters(DriveSpec drive, std::span<const DriveConstant> constants,
                          std::span<const double> values);

}  // namespace flexspline
