#pragma once

#include <nlohmann/json_fwd.hpp>

#include "flexspline/core/effect.hpp"

namespace flexspline::app {

/// All that a row says, as `list effects --json` and `explain --json` print it.
nlohmann::ordered_json effect_json(const EffectRow& row);

}  // namespace flexspline::app
