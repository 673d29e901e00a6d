#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double gap = amount * scale.torsion;
  const double width = scale.draw("backlash", 0, 0.02, 0.06) * scale.torque;
  HiddenLaw law;
  law.parameters = {{"half_gap", gap, "rad"}, {"width", width, "Nm"}};
  law.windup = [=](double torque) { return gap * soft_sign(torque, width); };
  return law;
}

}  // namespace

HiddenRow describe_backlash() {
  return {.id = "backlash",
          .coordinate = "torsion",
          .equation = "torsion += b tau / sqrt(tau^2 + t^2): lost motion 2b around zero torque",
          .site = HiddenSite::transmission,
          .rigs = {Rig::locked, Rig::free, Rig::specimen},
          .dissipates = false,
          .make = make};
}

}  // namespace flexspline::data
