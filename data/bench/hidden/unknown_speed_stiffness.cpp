#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double fast =
      scale.draw("unknown:speed_stiffness", 0, 0.1, 0.4) * scale.torsion * scale.mean_rate;
  const auto stiffness = scale.gear->stiffness;
  HiddenLaw law;
  law.parameters = {{"stiffening", amount, ""}, {"speed", fast, "rad/s"}};
  law.transmission = [=](const TorsionPoint& x) {
    const double ratio = x.rate / fast;
    return amount * stiffness(x.torsion) * (1.0 - 1.0 / std::sqrt(1.0 + ratio * ratio));
  };
  return law;
}

}  // namespace

HiddenRow describe_unknown_speed_stiffness() {
  return {.id = "unknown:speed_stiffness",
          .coordinate = "velocity",
          .equation =
              "tau += a f(phi) (1 - 1/sqrt(1 + (phi'/w)^2)): a spring that is stiffer in motion",
          .site = HiddenSite::transmission,
          .rigs = {Rig::locked, Rig::free, Rig::specimen},
          .dissipates = false,
          .make = make};
}

}  // namespace flexspline::data
