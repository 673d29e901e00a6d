#pragma once

#include <span>
#include <string>
#include <vector>

#include "flexspline/core/recording.hpp"

namespace flexspline::data {

/// Channels of which a rig needs one: each alternative is what has to be there together.
struct ChannelChoice {
  std::vector<std::vector<Quantity>> alternatives;
  bool exactly_one = false;  ///< else one at least
};

/// What a data set of a rig has to have, and may have.
struct RigChannels {
  Rig rig;
  std::vector<ChannelChoice> needs;  ///< besides time
  std::vector<Quantity> may_have;
  std::vector<Quantity> vary;  ///< without whose variation its equations say nothing
};

/// "motor_angle"; "torsion, angle, displacement"; "current, or duty_cycle with supply_voltage".
std::string words_of(const ChannelChoice& choice);

std::span<const RigChannels> rig_channels();
const RigChannels& rig_channels(Rig rig);

}  // namespace flexspline::data
