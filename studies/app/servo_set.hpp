#pragma once

#include <filesystem>

#include "command.hpp"
#include "flexspline/core/recording.hpp"
#include "flexspline/estimators/method.hpp"

namespace flexspline::app {

/// fit --model on a servo's recordings, which show no torque across the transmission: the angle is
/// simulated instead. held_out names recordings; absent, those that the set marks.
/// Options, defaults first: duty=recorded or loop, loss=squared or absolute, zero=recorded or
/// fitted, arm=massless or rod, starts=1 to 1000. Errors: bad_data, for others. Writes
/// DIR/estimate.json and DIR/model.toml.
Result<ExitCode> fit_servo_set(RecordingSet set, const estimators::GivenModel& model,
                               const std::optional<std::vector<std::string>>& held_out,
                               const estimators::Options& options,
                               const std::filesystem::path& folder, Console& console);

}  // namespace flexspline::app
