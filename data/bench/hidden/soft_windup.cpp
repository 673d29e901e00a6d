#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

/// Straight up to 1, level beyond.
double shoulder(double x) { return x / std::pow(1.0 + x * x * x * x, 0.25); }

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double windup = amount * scale.torsion;
  const double first = scale.draw("soft_windup", 0, 0.15, 0.25) * scale.torque;
  const double second = scale.draw("soft_windup", 1, 0.45, 0.65) * scale.torque;
  HiddenLaw law;
  law.parameters = {
      {"windup", windup, "rad"}, {"first_step", first, "Nm"}, {"second_step", second, "Nm"}};
  law.windup = [=](double torque) {
    return windup * (0.6 * shoulder(torque / first) + 0.4 * shoulder(torque / second));
  };
  return law;
}

}  // namespace

HiddenRow describe_soft_windup() {
  return {.id = "soft_windup",
          .coordinate = "torsion",
          .equation =
              "torsion += c (0.6 s(tau/T1) + 0.4 s(tau/T2)), s(x) = x/(1 + x^4)^(1/4): softer "
              "below T1, then below T2",
          .site = HiddenSite::transmission,
          .rigs = {Rig::locked, Rig::free, Rig::specimen},
          .dissipates = false,
          .make = make};
}

}  // namespace flexspline::data
