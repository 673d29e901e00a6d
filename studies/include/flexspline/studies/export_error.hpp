#pragma once

#include <string>
#include <vector>

#include "flexspline/core/drive_spec.hpp"
#include "flexspline/core/error.hpp"
#include "flexspline/core/recording.hpp"

namespace flexspline::studies {

/// How far a model in another form is from the model, both simulated by us under one excitation.
struct ExportError {
  std::string output;  ///< load_angle, motor_angle; torque of a specimen
  double rms = 0.0;    ///< over half the range of the model's output
  double largest = 0.0;
};

/// The excitation: 10 s of three sines of motor torque that wind the torsion up to 0.7 of what f is
/// valid to, beyond breakaway; of a specimen 10 s of motion over f's domain as fast as g^-1's.
/// Errors: a model that cannot be simulated.
Result<ExportError> export_error(const RigModel& model, const RigModel& exported);

/// Root mean square error of the recorded torques along the held-out recordings (all, where none is
/// marked), Nm, by the model and by its exported form.
struct HeldOutError {
  Quantity torque = Quantity::transmitted_torque;
  double model = 0.0;
  double exported = 0.0;
};

/// Errors: a set of another rig; a recording that cannot be simulated.
Result<std::vector<HeldOutError>> held_out_errors(const RigModel& model, const RigModel& exported,
                                                  const RecordingSet& set);

}  // namespace flexspline::studies
