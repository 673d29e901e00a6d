#pragma once

#include <string>
#include <vector>

#include "flexspline/core/drive_spec.hpp"
#include "flexspline/core/error.hpp"
#include "flexspline/core/model_spec.hpp"
#include "flexspline/core/recording.hpp"
#include "flexspline/core/signals.hpp"

namespace flexspline::app {

/// What drives a simulation: the motion, or in the other direction the effort.
struct Excitation {
  std::string id;
  Split split = Split::unassigned;
  std::optional<double> amplitude;
  std::optional<double> frequency_hz;
  Motion motion;
  std::vector<double> effort;  ///< used where the torsion is simulated
};

enum class Direction { torque, torsion };

/// A sine of so many cycles and samples a cycle; amplitude in rad, or in Nm for Direction::torsion.
Excitation sine_excitation(double amplitude, double frequency_hz, long cycles, long samples,
                           Direction direction);

/// The excitations of a data set, smoothed.
Result<std::vector<Excitation>> excitations_like(const RecordingSet& set);

/// Where simulated recordings leave the model's domain of validity.
struct Extrapolation {
  std::string says;  ///< in a sentence; empty: nowhere, but for 1 % of the samples
  bool far = false;  ///< by more than a tenth of a range
};

/// Errors: a law that cannot be made.
Result<Extrapolation> extrapolation(const ModelSpec& model, const RecordingSet& simulated);

/// Simulates eq. (4), or eq. (3) from the excitation's first motion, into a specimen's data set.
/// Errors: what the simulation refuses, with the recording's id.
Result<RecordingSet> simulate_set(const ModelSpec& model,
                                  const std::vector<Excitation>& excitations, Direction direction,
                                  const DisplayUnits& units);

/// The whole rig of a model in the recordings of a set, with the rig's constants: torques along the
/// motion, or with Direction::torsion the motions under what drives it.
/// Errors: a set of another rig; what the simulation refuses, with the recording's id.
Result<RecordingSet> simulate_rig_set(const RigModel& model, const RecordingSet& like,
                                      Direction direction);

}  // namespace flexspline::app
