#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double ripple = amount * scale.torque;
  const double order = scale.draw("unknown:order", 0, 0.62, 0.78);
  HiddenLaw law;
  law.parameters = {{"amplitude", ripple, "Nm"}, {"order", order, ""}};
  law.transmission = [=](const TorsionPoint& x) {
    return ripple * std::sin(order * x.motor_angle);
  };
  return law;
}

}  // namespace

HiddenRow describe_unknown_order() {
  return {.id = "unknown:order",
          .coordinate = "motor_angle",
          .equation = "tau += a sin(r th1), r between the orders a gear has",
          .site = HiddenSite::transmission,
          .rigs = {Rig::free},
          .dissipates = false,
          .make = make};
}

}  // namespace flexspline::data
