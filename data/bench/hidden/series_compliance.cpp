#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double compliance = amount * scale.torsion / scale.torque;
  HiddenLaw law;
  law.parameters = {{"stiffness", 1.0 / compliance, "Nm/rad"}};
  law.windup = [=](double torque) { return compliance * torque; };
  return law;
}

}  // namespace

HiddenRow describe_series_compliance() {
  return {.id = "series_compliance",
          .coordinate = "torsion",
          .equation = "torsion += tau / K",
          .site = HiddenSite::transmission,
          .rigs = {Rig::locked, Rig::free, Rig::specimen},
          .dissipates = false,
          .make = make};
}

}  // namespace flexspline::data
