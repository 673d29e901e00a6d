#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double error = 0.3 * amount * scale.torsion * scale.gear->gear_ratio;
  const double phase = scale.draw("variant:resolver_error", 0, 0.0, 6.2);
  HiddenLaw law;
  law.parameters = {{"amplitude", error, "rad"}};
  law.sensing = [=](HiddenSignals& s) {
    for (double& angle : s.motor_angle) {
      angle += error * (std::sin(2.0 * angle + phase) - std::sin(phase));
    }
  };
  return law;
}

}  // namespace

HiddenRow describe_variant_resolver_error() {
  return {.id = "variant:resolver_error",
          .coordinate = "motor_angle",
          .equation = "y_1 = th1 + N a (sin(2 th1 + p) - sin p): a resolver's unequal windings",
          .site = HiddenSite::encoder,
          .rigs = {Rig::free},
          .dissipates = false,
          .make = make,
          .names = {"encoder_eccentricity", "kinematic_error"}};
}

}  // namespace flexspline::data
