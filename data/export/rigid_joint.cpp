#include "export/rigid_joint.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "export/carrier.hpp"
#include "export/inertia_there.hpp"

namespace flexspline::data {
namespace {

double friction_of(const DriveSpec& d, std::string_view name) {
  double sum = 0.0;
  for (const EffectSpec& one : d.torsion.effects) {
    if (one.effect != "coulomb_viscous_friction") continue;
    for (const auto& [key, value] : one.parameters) sum += key == name ? value : 0.0;
  }
  return sum;
}

}  // namespace

Result<Carried> carry_rigidly(const RigModel& model, std::string_view form) {
  if (model.rig == Rig::specimen || model.rig == Rig::locked) {
    return failure(
        ErrorCode::bad_data,
        fmt::format("a {} rig's model has no turning output for {}", name_of(model.rig), form),
        "export a free or servo rig's, or as c99, fmu or table");
  }
  if (auto there = inertia_there(model, form, true); !there) return tl::unexpected(there.error());
  Carrier carrier(model);
  carrier.drop_instruments();
  carrier.drop_effects([&](const EffectRow& row, const EffectSpec& effect) {
    const bool kept = row.id == "coulomb_viscous_friction" && !effect.across;
    return kept ? std::string() : fmt::format("{} has no element for it", form);
  });
  carrier.change(
      "compliance and hysteresis of the transmission",
      fmt::format("a joint of {} is rigid; motor and load turn as one", form),
      [](RigModel& m) { m.rig = Rig::servo; },
      [](const RigModel& m) { return m.rig == Rig::free; });
  return std::move(carrier).done();
}

RigidJoint rigid_joint(const DriveSpec& d) {
  const double n = d.gear_ratio;
  RigidJoint joint;
  joint.motor_inertia = reflected_inertia(d);
  joint.damping = n * n * (d.motor_viscous + friction_of(d, "viscous")) + d.load_viscous;
  joint.friction = n * (d.motor_coulomb + friction_of(d, "coulomb"));
  joint.mass = d.load_mass > 0.0 ? d.load_mass : 1.0;
  joint.arm = d.load_mass > 0.0 ? d.arm_length : 0.0;
  joint.inertia = std::max(d.load_inertia - joint.mass * joint.arm * joint.arm, 1e-9);
  return joint;
}

}  // namespace flexspline::data
