#pragma once

#include "diagnosis/model/model.hpp"
#include "flexspline/core/drive_spec.hpp"

namespace flexspline::studies {

/// True torque over what was read of it: of the motor, and of the sensor across the transmission.
struct TorqueGains {
  double motor = 1.0;
  double sensor = 1.0;
};

/// A rig's constants: ratio, inertias and masses as known, viscous and dry friction of the
/// baseline. Dry friction beyond its largest part stands as effects coulomb_viscous_friction.
struct RigConstants {
  DriveSpec drive;
  /// On a servo the known weight of its load is what tells a torque: tau_m = K u, K = 1/(N c) for
  /// u = c m g l sin(theta) + ...; its transmitted torque is in units of that weight.
  TorqueGains gains;

  /// A cause's coefficients in an equation of true torques.
  Eigen::VectorXd in_torque(const Frame& frame, const ActiveCause& cause, Equation equation,
                            const Eigen::VectorXd& coefficients, const Reference& reference) const;
};

/// Takes the gain that an effect of the catalogue tells.
void take_gain(const EffectSpec& effect, TorqueGains& gains);

/// What a sensor adds to the torque that it reads is in the torque that is read.
bool of_torque_sensor(const Counterpart& counterpart);

/// A cause's coefficients as the catalogue means them: of a cause that rescales a torque the
/// catalogue's parameter, of others in true torques where one of the model does, but for what a
/// sensor adds to its readings.
Eigen::VectorXd catalogued_coefficients(const Frame& frame, const DriveModel& model,
                                        std::size_t cause, const Reference& reference);

/// gains: by causes of the model; a servo's motor has its own.
RigConstants rig_constants(const Frame& frame, const DriveModel& model, TorqueGains gains);

/// Where the constants and laws of a diagnosis' model come from. What the set states stays given,
/// but for an inertia that a cause corrects.
void mark_origin(const Frame& frame, RigModel& model);

}  // namespace flexspline::studies
