#pragma once

#include "diagnosis/model.hpp"
#include "flexspline/core/drive_spec.hpp"

namespace flexspline::studies {

/// A rig's constants: ratio, inertias and masses as known, viscous and dry friction of the
/// baseline. Dry friction beyond its largest part stands as effects coulomb_viscous_friction.
struct RigConstants {
  DriveSpec drive;
  /// Nm of the motor over what of it was recorded. Not 1 on a servo alone, where the known weight
  /// of its load is what tells a torque: tau_m = K u, K = 1/(N c) for u = c m g l sin(theta) + ...
  double torque_of_recorded = 1.0;

  /// A cause's coefficients with the motor's torque in Nm.
  Eigen::VectorXd in_torque(const Frame& frame, const ActiveCause& cause,
                            const Eigen::VectorXd& coefficients, const Reference& reference) const;
};

RigConstants rig_constants(const Frame& frame, const DriveModel& model);

/// Where the constants and laws of a diagnosis' model come from. What the set states stays given,
/// but for an inertia that a cause corrects.
void mark_origin(const Frame& frame, RigModel& model);

}  // namespace flexspline::studies
