#pragma once

#include "flexspline/core/error.hpp"
#include "flexspline/estimators/given_parameters.hpp"
#include "flexspline/estimators/ode_fit.hpp"
#include "flexspline/estimators/servo_fit.hpp"

namespace flexspline::estimators {

/// What an unknown makes of a parameter of the rig: base + slope times it.
struct RigTarget {
  std::size_t at = 0;  ///< in the rig's parameter vector
  double base = 0.0;
  double slope = 1.0;
};

/// The unknowns of a servo's fit and what each makes of the rig's parameters.
struct ServoUnknowns {
  std::vector<OdeParameter> parameters;
  std::vector<std::vector<RigTarget>> targets;
};

/// The drive with its weight as an effect, gravity_load, the last one: its phase is the zero of the
/// angle.
DriveSpec with_weight_as_effect(DriveSpec drive);

/// Torque constant (and back-EMF), resistance, motor inertia, what the settings make unknown of the
/// arm and of the zero of the angle, and the numbers of the model's effects that are not held. The
/// drive's weight is an effect.
ServoUnknowns servo_unknowns(const DriveSpec& drive, const std::vector<DriveParameter>& all,
                             const std::vector<GivenParameter>& given,
                             const ServoSettings& settings);

/// Unknowns by name start where they are told to; their bounds and scales stay.
/// Errors: bad_data, for a name that is no unknown and for a start beyond its bounds.
Result<void> start_at(const std::map<std::string, double>& starts, ServoUnknowns& unknowns);

}  // namespace flexspline::estimators
