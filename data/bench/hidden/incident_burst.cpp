#include <numbers>

#include "bench/hidden_incident.hpp"

namespace flexspline::data {
namespace {

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double height = amount * scale.effort_peak();
  const double cycles = scale.draw("incident:burst", 0, 4.0, 9.0);
  const double length = scale.draw("incident:burst", 1, 0.08, 0.15);
  constexpr double kTurn = 2.0 * std::numbers::pi;
  return incident_law(scale, "incident:burst", 0.1, 0.75, length, [=](double share) {
    return height * 0.5 * (1.0 - std::cos(kTurn * share)) * std::sin(kTurn * cycles * share);
  });
}

}  // namespace

HiddenRow describe_incident_burst() {
  return {.id = "incident:burst",
          .coordinate = "window",
          .equation = "y += a (1 - cos 2 pi u)/2 sin(2 pi n u), u over a tenth of one recording",
          .site = HiddenSite::torque_sensor,
          .rigs = {Rig::locked, Rig::free, Rig::specimen, Rig::servo},
          .dissipates = false,
          .make = make,
          .joint = true};
}

}  // namespace flexspline::data
