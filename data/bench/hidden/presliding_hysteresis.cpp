#include <memory>

#include "bench/everett_memory.hpp"
#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

HiddenLaw make(const HiddenScale& scale, double amount) {
  const bool servo = scale.rig == Rig::servo;
  const double travel = servo ? scale.motion * scale.gear->gear_ratio : scale.torsion;
  const double height = amount * (servo ? scale.motor_torque : scale.torque);
  // Of a joint's travel presliding is a small part.
  const double part = servo ? 0.3 : (scale.travels ? 0.1 : 1.0);
  const double width = scale.draw("presliding_hysteresis", 0, 0.08, 0.25) * travel * part;
  auto memory = std::make_shared<EverettMemory>(EverettShape{height, width, 2.0 * travel});
  HiddenLaw law;
  law.parameters = {{"height", height, "Nm"}, {"width", width, "rad"}};
  if (servo) {
    law.motor = [memory](const MotorPoint& x) {
      *memory = memory->moved(x.angle);
      return memory->torque();
    };
    return law;
  }
  law.transmission = [memory](const TorsionPoint& x) { return memory->moved(x.torsion).torque(); };
  law.remember = [memory](const TorsionPoint& x) { *memory = memory->moved(x.torsion); };
  return law;
}

}  // namespace

HiddenRow describe_presliding_hysteresis() {
  return {.id = "presliding_hysteresis",
          .coordinate = "reversal_memory",
          .equation =
              "torque += z: Preisach memory by its Everett function, z = a x/(x + w) on the virgin "
              "curve; at the motor on a servo",
          .site = HiddenSite::transmission,
          .rigs = {Rig::locked, Rig::free, Rig::specimen, Rig::servo},
          .dissipates = true,
          .make = make,
          .joint = true};
}

}  // namespace flexspline::data
