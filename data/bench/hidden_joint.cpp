#include <cmath>

#include <fmt/format.h>

#include "bench/hidden_draw.hpp"
#include "bench/hidden_gear.hpp"
#include "bench/hidden_law.hpp"

namespace flexspline::data {

HiddenGear draw_joint(std::uint64_t seed) {
  const auto between = [seed](std::uint64_t index, double low, double high) {
    return drawn(seed, "joint", index, low, high);
  };
  const double weight = between(0, 6.0, 20.0);
  const double phase = between(1, -0.8, 0.8);
  const double cable = weight * between(2, 0.05, 0.2);
  const double stop = weight * between(3, -0.15, 0.15);
  const double coulomb = weight * between(4, 0.08, 0.2);
  const double viscous = coulomb * between(5, 0.4, 1.2);
  const double width = between(6, 0.004, 0.015);
  HiddenGear gear;
  gear.families = fmt::format(
      "f G (sin(q + {:.3g}) - sin) + {:.3g} q + {:.3g} q^3; g^-1 Coulomb and viscous; h 1", phase,
      cable, stop);
  gear.gear_ratio = 50.0;
  gear.rated_torsion = between(7, 0.5, 0.9);
  gear.rated_torque = weight;
  gear.stiffness = [=](double q) {
    return weight * (std::sin(q + phase) - std::sin(phase)) + (cable + stop * q * q) * q;
  };
  gear.damping = [=](double rate) { return coulomb * soft_sign(rate, width) + viscous * rate; };
  gear.modulation = [](double) { return 1.0; };
  return gear;
}

std::vector<HiddenExcitation> joint_design(std::uint64_t seed, double travel) {
  std::vector<HiddenExcitation> design;
  const auto add = [&](HiddenMotion motion, double amplitude, double frequency, double cycles) {
    const double samples = drawn(seed, "samples", design.size(), 1500.0, 2000.0);
    design.push_back({motion, amplitude, frequency, cycles, static_cast<int>(samples)});
  };
  constexpr double kLegs = 0.24;  // of a cycle, at the speed of a ramp
  for (const double speed : {0.1, 0.2, 0.35, 0.6}) {
    const double share = drawn(seed, "amplitude", design.size(), 0.85, 1.0);
    const double about = speed * drawn(seed, "rate", design.size(), 0.85, 1.15);
    add(HiddenMotion::ramp, share * travel, kLegs * about / (share * travel), 1.0);
  }
  for (const double share : {0.3, 0.8}) add(HiddenMotion::sine, share * travel, 0.06 / share, 2.5);
  add(HiddenMotion::multisine, 0.8 * travel, 0.03, 2.0);
  add(HiddenMotion::staircase, travel, kLegs * 0.035 / travel, 1.0);
  return design;
}

}  // namespace flexspline::data
