#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double error = 0.3 * amount * scale.torsion;
  const double order = scale.draw("variant:kinematic_order", 0, 2.02, 2.08);
  const double phase = scale.draw("variant:kinematic_order", 1, 0.0, 6.2);
  HiddenLaw law;
  law.parameters = {{"amplitude", error, "rad"}, {"order", order, ""}};
  law.kinematic = [=](double angle) {
    return error * (std::sin(order * angle + phase) - std::sin(phase));
  };
  return law;
}

}  // namespace

HiddenRow describe_variant_kinematic_order() {
  return {.id = "variant:kinematic_order",
          .coordinate = "motor_angle",
          .equation =
              "torsion += e (sin(r th1 + p) - sin p), r = 2.02 to 2.08: two waves over a tooth "
              "count that differs by two",
          .site = HiddenSite::transmission,
          .rigs = {Rig::free},
          .dissipates = false,
          .make = make,
          .names = {"kinematic_error"}};
}

}  // namespace flexspline::data
