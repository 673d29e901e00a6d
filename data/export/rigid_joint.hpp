#pragma once

#include "flexspline/data/exporter.hpp"

namespace flexspline::data {

/// A drive as one joint of the output with inertia, viscous and dry friction, which is all that
/// robot description formats know of a drive.
struct RigidJoint {
  double inertia = 0.0;        ///< of the load, kg m2
  double motor_inertia = 0.0;  ///< N^2 J1, kg m2
  double damping = 0.0;        ///< N^2 B1 + B2, Nm s/rad
  double friction = 0.0;       ///< N C1, Nm
  double mass = 1.0;           ///< kg, of the load, hanging on
  double arm = 0.0;            ///< m
};

/// The rigid servo of a drive. Errors: a specimen, a locked output.
Result<Carried> carry_rigidly(const RigModel& model, std::string_view form);

RigidJoint rigid_joint(const DriveSpec& drive);

}  // namespace flexspline::data
