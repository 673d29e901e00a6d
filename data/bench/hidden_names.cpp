#include <string>

#include "flexspline/data/hidden_bench.hpp"

namespace flexspline::data {

std::string_view name_of(HiddenEquation equation) {
  switch (equation) {
    case HiddenEquation::torsion:
      return "torsion";
    case HiddenEquation::load:
      return "load";
    case HiddenEquation::motor:
      return "motor";
    case HiddenEquation::drive:
      break;
  }
  return "drive";
}

std::string_view name_of(HiddenMotion motion) {
  switch (motion) {
    case HiddenMotion::sine:
      return "sine";
    case HiddenMotion::multisine:
      return "multisine";
    case HiddenMotion::ramp:
      return "ramp";
    case HiddenMotion::step_hold:
      return "step_hold";
    case HiddenMotion::staircase:
      break;
  }
  return "staircase";
}

HiddenEquation hidden_equation(HiddenSite site, Rig rig) {
  if (rig == Rig::servo) return HiddenEquation::drive;
  if (site == HiddenSite::motor_sensor) return HiddenEquation::motor;
  if (site == HiddenSite::motor && rig != Rig::specimen) return HiddenEquation::motor;
  if (site == HiddenSite::load && rig == Rig::free) return HiddenEquation::load;
  return HiddenEquation::torsion;
}

Result<const HiddenRow*> find_hidden_effect(std::string_view id) {
  std::string known;
  for (const HiddenRow& row : hidden_effects()) {
    if (row.id == id) return &row;
    known += (known.empty() ? "" : ", ") + std::string(row.id);
  }
  return failure(ErrorCode::usage, "effect \"" + std::string(id) + "\" cannot be concealed",
                 "choose one of " + known);
}

}  // namespace flexspline::data
