#include "diagnosis/frame/equations_of.hpp"

#include <fmt/format.h>

namespace flexspline::studies {
namespace {

const char* remedy_on(Rig rig) {
  if (rig == Rig::free) {
    return "measure transmitted_torque, or state load_inertia_kgm2 in [constants]: the load's "
           "inertia then tells it";
  }
  return "a diagnosis needs a transmitted torque, torque or force, or on a servo what drives "
         "it and the load's angle";
}

}  // namespace

Result<std::vector<Equation>> equations_of(const RecordingSet& set, std::string_view recording,
                                           const DriveChannels& c) {
  const bool drives = !c.motor_torque.empty();
  if (set.rig == Rig::servo && drives && !c.load_angle.empty()) return {{Equation::motor}};
  const bool by_inertia = has_torque_by_inertia(set) && !c.load_angle.empty();
  if (set.rig == Rig::servo || (c.transmitted_torque.empty() && !by_inertia)) {
    return failure(ErrorCode::bad_data,
                   fmt::format("recording {} has no torque to explain", recording),
                   remedy_on(set.rig));
  }
  std::vector<Equation> list = {Equation::torsion};
  if (set.rig == Rig::free && !by_inertia && set.constants.contains("load_inertia_kgm2")) {
    list.push_back(Equation::load);
  }
  if (set.rig != Rig::specimen && drives && set.constants.contains("motor_inertia_kgm2")) {
    list.push_back(Equation::motor);
  }
  return list;
}

}  // namespace flexspline::studies
