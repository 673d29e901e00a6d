#pragma once

#include <nlohmann/json_fwd.hpp>

#include "flexspline/core/drive_spec.hpp"
#include "flexspline/core/error.hpp"
#include "flexspline/core/estimate.hpp"
#include "flexspline/core/model_spec.hpp"
#include "flexspline/core/recording.hpp"

namespace flexspline::data {

/// An estimate as artefact of schema "flexspline-estimate/1". Bands are in the units given: f and h
/// over motion, g_inverse over motion per second, f and g_inverse in effort, h without a unit. The
/// model is complete and in SI. What was not computed is null.
nlohmann::ordered_json to_json(const Estimate& estimate, const DisplayUnits& units);

/// Its parameters alone: name, value, std, ci95, unit, bound_active.
nlohmann::ordered_json to_json(const std::vector<ParameterEstimate>& parameters);

/// A model with every number of it, SI.
nlohmann::ordered_json to_json(const ModelSpec& model);

/// The same with "rig": its id, gear_ratio and constants.
nlohmann::ordered_json to_json(const RigModel& model);

/// The inverse of to_json, exact to the last bit.
/// Errors: bad_data for a key that is missing or a number that is null.
Result<ModelSpec> model_from_json(const nlohmann::ordered_json& json);

}  // namespace flexspline::data
