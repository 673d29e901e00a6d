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

std::vector<std::string> twins_of(std::string_view effect, data::BenchKind rig) {
  std::vector<std::string> twins;
  for (const StructuralTwin& row : structural_twins()) {
    if (std::ranges::find(row.rigs, rig.rig) == row.rigs.end()) continue;
    if (row.effect == effect) twins.emplace_back(row.twin);
    if (row.twin == effect) twins.emplace_back(row.effect);
  }
  return twins;
}

std::vector<std::string> concealable(data::BenchKind rig, data::HiddenClass of) {
  std::vector<std::string> ids;
  for (const data::HiddenRow& row : data::hidden_effects()) {
    if (row.shows_on(rig) && data::hidden_class(row.id) == of) ids.emplace_back(row.id);
  }
  return ids;
}

std::vector<std::string> disturbances_on(data::BenchKind rig) {
  std::vector<std::string> ids;
  for (const data::DisturbanceRow& row : data::disturbances()) {
    if (std::ranges::find(row.kinds, rig) != row.kinds.end()) ids.emplace_back(row.id);
  }
  return ids;
}

}  // namespace flexspline::studies
