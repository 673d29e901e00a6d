#include <algorithm>

#include "flexspline/studies/conceal.hpp"

namespace flexspline::studies {

std::span<const StructuralTwin> structural_twins() {
  static const std::vector<StructuralTwin> rows = {
      {"torque_constant_error",
       "torque_sensor_gain",
       {Rig::locked},
       "no load is known, so that only the ratio of the two torques is seen: a motor torque too "
       "large by a share and a sensor torque too small by it are one, and the stiffness takes up "
       "the scale of the sensor"},
      {"direction_asymmetry",
       "motor_torque_offset",
       {Rig::free},
       "a friction that is larger in one direction is half its excess as a constant and half of it "
       "as Coulomb friction, which the baseline has; the shaft is hardly ever slow enough to tell "
       "the rest"},
  };
  return rows;
}

std::vector<std::string> twins_of(std::string_view effect, Rig rig) {
  std::vector<std::string> twins;
  for (const StructuralTwin& row : structural_twins()) {
    if (std::ranges::find(row.rigs, rig) == row.rigs.end()) continue;
    if (row.effect == effect) twins.emplace_back(row.twin);
    if (row.twin == effect) twins.emplace_back(row.effect);
  }
  return twins;
}

std::vector<std::string> concealable(Rig rig, bool catalogued) {
  std::vector<std::string> ids;
  for (const data::HiddenRow& row : data::hidden_effects()) {
    if (std::ranges::find(row.rigs, rig) == row.rigs.end()) continue;
    if (row.id.starts_with("unknown:") != catalogued) ids.emplace_back(row.id);
  }
  return ids;
}

}  // namespace flexspline::studies
