#include <algorithm>
#include <cmath>
#include <memory>

#include "bench/hidden_law.hpp"

namespace flexspline::data {
namespace {

HiddenLaw make(const HiddenScale& scale, double amount) {
  const double loss = amount * scale.torque;
  const double peak = scale.torsion;
  auto farthest = std::make_shared<double>(0.0);
  HiddenLaw law;
  law.parameters = {{"loss", loss, "Nm"}};
  law.transmission = [=](const TorsionPoint& x) {
    const double reach = std::max(*farthest, std::abs(x.torsion));
    return -loss * (x.torsion / peak) * (reach / peak);
  };
  law.remember = [farthest](const TorsionPoint& x) {
    *farthest = std::max(*farthest, std::abs(x.torsion));
  };
  return law;
}

}  // namespace

HiddenRow describe_unknown_softening() {
  return {.id = "unknown:softening",
          .coordinate = "",
          .equation =
              "tau -= a (phi/peak) (m/peak), m the farthest torsion since the start: a spring that "
              "softens for good (Mullins)",
          .site = HiddenSite::transmission,
          .rigs = {Rig::locked, Rig::free, Rig::specimen},
          .dissipates = false,
          .make = make};
}

}  // namespace flexspline::data
