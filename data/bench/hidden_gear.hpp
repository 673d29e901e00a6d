#pragma once

#include <cstdint>

#include "flexspline/data/hidden_bench.hpp"

namespace flexspline::data {

/// A gear drawn from a seed. speed is the torsion rate around which g^-1 bends, rad/s.
HiddenGear draw_gear(Rig rig, std::uint64_t seed, double rated_torque, double rated_torsion,
                     double speed);

/// Recordings that ask the gear for its rated torque.
std::vector<HiddenExcitation> draw_design(Rig rig, std::uint64_t seed, const HiddenGear& gear);

/// A joint whose angle travels: weight, cables and a stop over the angle, neither odd nor rising;
/// Coulomb and viscous friction.
HiddenGear draw_joint(std::uint64_t seed);

/// Ramps at four speeds, sines, a multisine and a staircase over a travel, rad.
std::vector<HiddenExcitation> joint_design(std::uint64_t seed, double travel);

}  // namespace flexspline::data
