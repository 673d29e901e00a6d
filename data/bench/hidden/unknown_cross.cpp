#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double per = amount * scale.torque / (scale.motion * scale.speed);
  HiddenLaw law;
  law.parameters = {{"coefficient", per, "Nm s/rad2"}};
  law.load = [=](const LoadPoint& x) { return per * x.angle * x.velocity; };
  return law;
}

}  // namespace

HiddenRow describe_unknown_cross() {
  return {.id = "unknown:cross",
          .coordinate = "",
          .equation = "tau += a (q/peak) (q'/peak), q the held shaft: position times speed",
          .site = HiddenSite::load,
          .rigs = {Rig::locked, Rig::free, Rig::specimen, Rig::servo},
          .dissipates = false,
          .make = make,
          .joint = true};
}

}  // namespace flexspline::data
