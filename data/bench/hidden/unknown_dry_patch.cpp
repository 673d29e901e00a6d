#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double height = amount * scale.torque;
  const double place = scale.draw("unknown:dry_patch", 0, -0.5, 0.5) * scale.motion;
  const double width = scale.draw("unknown:dry_patch", 1, 0.1, 0.2) * scale.motion;
  const double slow = 0.03 * scale.speed;
  HiddenLaw law;
  law.parameters = {{"height", height, "Nm"}, {"place", place, "rad"}, {"width", width, "rad"}};
  law.load = [=](const LoadPoint& x) {
    const double off = (x.angle - place) / width;
    return height * std::exp(-0.5 * off * off) * soft_sign(x.velocity, slow);
  };
  return law;
}

}  // namespace

HiddenRow describe_unknown_dry_patch() {
  return {.id = "unknown:dry_patch",
          .coordinate = "load_angle",
          .equation =
              "tau += a exp(-((q - q0)/w)^2/2) q'/sqrt(q'^2 + e^2), q the held shaft: a seat that "
              "rubs at one angle",
          .site = HiddenSite::load,
          .rigs = {Rig::free, Rig::servo},
          .dissipates = true,
          .make = make,
          .joint = true};
}

}  // namespace flexspline::data
