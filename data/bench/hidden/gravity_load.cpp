#include <algorithm>

#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double moment = amount * scale.torque / std::sin(std::min(scale.motion, 1.5));
  HiddenLaw law;
  law.parameters = {{"mass_moment", moment, "Nm"}};
  law.load = [=](const LoadPoint& x) { return moment * std::sin(x.angle); };
  return law;
}

}  // namespace

HiddenRow describe_gravity_load() {
  return {.id = "gravity_load",
          .coordinate = "load_angle",
          .equation = "tau += m g l sin(th2): an eccentric load that hangs at rest",
          .site = HiddenSite::load,
          .rigs = {Rig::free},
          .dissipates = false,
          .make = make};
}

}  // namespace flexspline::data
