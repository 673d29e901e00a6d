#include "bench/hidden_incident.hpp"

namespace flexspline::data {
namespace {

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double height = amount * scale.effort_peak();
  const double sign = scale.draw("incident:glitch", 0, -1.0, 1.0) < 0.0 ? -1.0 : 1.0;
  const double length = scale.draw("incident:glitch", 1, 0.006, 0.012);
  return incident_law(scale, "incident:glitch", 0.1, 0.9, length,
                      [=](double) { return sign * height; });
}

}  // namespace

HiddenRow describe_incident_glitch() {
  return {.id = "incident:glitch",
          .coordinate = "window",
          .equation = "y += +-a over a hundredth of one recording: a loose contact",
          .site = HiddenSite::torque_sensor,
          .rigs = {Rig::locked, Rig::free, Rig::specimen, Rig::servo},
          .dissipates = false,
          .make = make,
          .joint = true};
}

}  // namespace flexspline::data
