#pragma once

#include <filesystem>

#include <nlohmann/json.hpp>

#include "flexspline/core/drive_spec.hpp"
#include "flexspline/core/error.hpp"
#include "flexspline/core/recording.hpp"

namespace flexspline::app {

/// The whole rig of a fit, as model.toml holds it, and what estimate.json says of it: below `rig`
/// the constants fitted with their intervals, rms errors of the motor torque by recording, notes.
struct FittedRig {
  RigModel model;
  nlohmann::ordered_json says;
};

/// Of an estimate of the torsion law, whose JSON it is. The set is marked with what was held out.
/// Errors: those of complete_rig.
Result<FittedRig> fitted_rig(const RecordingSet& set, const nlohmann::ordered_json& estimate);

/// Of a servo's drive.
FittedRig fitted_servo(const RecordingSet& set, const DriveSpec& drive,
                       const nlohmann::ordered_json& estimate);

/// DIR/model.toml, and DIR/estimate.json with `rig` in it. Errors: cannot_write.
Result<void> write_fit(const std::filesystem::path& folder, nlohmann::ordered_json& estimate,
                       const FittedRig& rig);

/// For people: constants, errors and notes, a line each.
std::string text_of(const FittedRig& rig);

}  // namespace flexspline::app
