#pragma once

#include <string>

#include "flexspline/core/drive_spec.hpp"
#include "flexspline/core/effect.hpp"

namespace flexspline::data {

/// Friction with memory as MuJoCo holds it: LuGre's bristles, F = s0 z + s1 z',
/// z' = v - s0 |v| z/g, g = tc + (ts - tc) exp(-(v/vs)^2), by a passive dcmotor; slip elements by a
/// spring to a hinge that dry friction holds.

/// Empty where an effect fits, else why not.
std::string no_place_for_friction(const EffectRow& row, const EffectSpec& effect);

/// Whether the motor's dry friction has a Stribeck part, which bristles alone can hold.
bool has_stribeck(const RigModel& model);

/// All dry friction at the motor as one lugre_friction, which computes what the dcmotor does: its
/// bristles are as stiff as makes the motor swing at 300 rad/s on them.
void gather_in_bristles(RigModel& model);

/// Whether anything of a model is bristles: the step has to be shorter.
bool has_bristles(const DriveSpec& drive);

std::string slip_bodies(const DriveSpec& drive);
std::string slip_tendons(const RigModel& model);
std::string bristle_actuators(const RigModel& model);

}  // namespace flexspline::data
