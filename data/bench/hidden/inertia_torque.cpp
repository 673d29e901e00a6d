#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double inertia = amount * scale.torque / scale.acceleration;
  HiddenLaw law;
  law.parameters = {{"inertia", inertia, "kg m2"}};
  law.load = [=](const LoadPoint& x) { return inertia * x.acceleration; };
  return law;
}

}  // namespace

HiddenRow describe_inertia_torque() {
  return {.id = "inertia_torque",
          .coordinate = "acceleration",
          .equation = "tau += J q'', q the held shaft",
          .site = HiddenSite::load,
          .rigs = {Rig::locked, Rig::free, Rig::specimen},
          .dissipates = false,
          .make = make,
          .joint = true};
}

}  // namespace flexspline::data
