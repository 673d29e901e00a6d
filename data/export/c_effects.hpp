#pragma once

#include <string>
#include <utility>
#include <vector>

#include "flexspline/core/effect.hpp"

namespace flexspline::data {

/// The effects of a model as C functions of an instant x and their memory z: at_motor, at_load,
/// at_transmission, kinematics with their derivatives, and memory_rates.
struct CEffects {
  std::vector<std::pair<std::string, std::string>> functions;  ///< name, text
  std::size_t memory = 0;
};

/// Why an effect cannot be computed forward in C; empty: it can.
std::string no_c_effect(const EffectRow& row, const EffectSpec& effect);

/// Errors: an effect whose parameters do not fit it.
Result<CEffects> c_effects(const ModelSpec& model);

}  // namespace flexspline::data
