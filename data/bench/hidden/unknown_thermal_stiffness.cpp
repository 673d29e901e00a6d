#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double time = scale.draw("unknown:thermal_stiffness", 0, 0.3, 1.0) * scale.clock_end;
  const auto stiffness = scale.gear->stiffness;
  HiddenLaw law;
  law.parameters = {{"softening", amount, ""}, {"time", time, "s"}};
  law.transmission = [=](const TorsionPoint& x) {
    return amount * stiffness(x.torsion) * std::expm1(-x.clock / time);
  };
  return law;
}

}  // namespace

HiddenRow describe_unknown_thermal_stiffness() {
  return {.id = "unknown:thermal_stiffness",
          .coordinate = "time",
          .equation = "tau -= a f(phi) (1 - exp(-clock/T)): a spring that softens as it warms up",
          .site = HiddenSite::transmission,
          .rigs = {Rig::locked, Rig::free, Rig::specimen},
          .dissipates = false,
          .make = make};
}

}  // namespace flexspline::data
