#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

/// Zero at the start, where the angles were zeroed.
double wave(double angle, double phase) { return std::sin(angle + phase) - std::sin(phase); }

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double error = 0.3 * amount * scale.torsion;
  const double p2 = scale.draw("kinematic_error", 0, 0.0, 6.2);
  const double p4 = scale.draw("kinematic_error", 1, 0.0, 6.2);
  const double p1 = scale.draw("kinematic_error", 2, 0.0, 6.2);
  HiddenLaw law;
  law.parameters = {{"amplitude_order_2", error, "rad"}};
  law.kinematic = [=](double angle) {
    return error * (wave(2.0 * angle, p2) + 0.3 * wave(4.0 * angle, p4) + 0.25 * wave(angle, p1));
  };
  return law;
}

}  // namespace

HiddenRow describe_kinematic_error() {
  return {
      .id = "kinematic_error",
      .coordinate = "motor_angle",
      .equation =
          "torsion += sum_k e_k (sin(k th1 + p_k) - sin p_k), k = 2, 4, 1 in shares 1 : 0.3 : 0.25",
      .site = HiddenSite::transmission,
      .rigs = {Rig::free},
      .dissipates = false,
      .make = make};
}

}  // namespace flexspline::data
