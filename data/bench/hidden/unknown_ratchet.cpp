#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

constexpr double kOrder = 1.37;

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double swing = 0.75 * amount * scale.torque;
  const double peak = scale.torsion;
  HiddenLaw law;
  law.parameters = {{"amplitude", swing, "Nm"}, {"order", kOrder, ""}};
  law.transmission = [=](const TorsionPoint& x) {
    const double turn = kOrder * x.motor_angle;
    return swing * (x.torsion / peak) * std::sin(turn) / (1.25 - std::cos(turn));
  };
  return law;
}

}  // namespace

HiddenRow describe_unknown_ratchet() {
  return {.id = "unknown:ratchet",
          .coordinate = "",
          .equation =
              "tau += a (phi/peak) s(1.37 th1), s(u) = sin u / (1.25 - cos u): stiffness in a saw "
              "over the angle",
          .site = HiddenSite::transmission,
          .rigs = {Rig::free},
          .dissipates = false,
          .make = make};
}

}  // namespace flexspline::data
