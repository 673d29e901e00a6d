#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double error = 0.3 * amount * scale.torsion * scale.gear->gear_ratio;
  const double phase = scale.draw("encoder_eccentricity", 0, 0.0, 6.2);
  HiddenLaw law;
  law.parameters = {{"amplitude_at_motor", error, "rad"}};
  law.sensing = [=](HiddenSignals& s) {
    for (double& angle : s.motor_angle)
      angle += error * (std::sin(angle + phase) - std::sin(phase));
  };
  return law;
}

}  // namespace

HiddenRow describe_encoder_eccentricity() {
  return {.id = "encoder_eccentricity",
          .coordinate = "motor_angle",
          .equation = "y_1 = th1 + N a (sin(th1 + p) - sin p)",
          .site = HiddenSite::encoder,
          .rigs = {Rig::free},
          .dissipates = false,
          .make = make};
}

}  // namespace flexspline::data
