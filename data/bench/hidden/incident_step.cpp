#include "bench/hidden_incident.hpp"

namespace flexspline::data {
namespace {

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double height = amount * scale.effort_peak();
  return incident_law(scale, "incident:step", 0.25, 0.75, 1.0, [=](double) { return height; });
}

}  // namespace

HiddenRow describe_incident_step() {
  return {.id = "incident:step",
          .coordinate = "window",
          .equation = "y += a from one instant of one recording to its end: a sensor that slips",
          .site = HiddenSite::torque_sensor,
          .rigs = {Rig::locked, Rig::free, Rig::specimen, Rig::servo},
          .dissipates = false,
          .make = make,
          .joint = true};
}

}  // namespace flexspline::data
