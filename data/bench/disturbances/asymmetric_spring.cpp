#include <cmath>

#include "bench/hidden_draw.hpp"
#include "flexspline/data/hidden_bench.hpp"

namespace flexspline::data {
namespace {

/// Smooth over a tenth of the rated torsion: no gear has a corner.
std::vector<HiddenParameter> apply(HiddenBench& bench, std::uint64_t seed) {
  const double excess = drawn(seed, "asymmetric_spring", 0, 0.0, 0.1);
  const double side = drawn(seed, "asymmetric_spring", 1, -1.0, 1.0) < 0.0 ? -1.0 : 1.0;
  const double width = 0.1 * bench.gear.rated_torsion;
  bench.gear.stiffness = [=, even = bench.gear.stiffness](double phi) {
    return even(phi) * (1.0 + 0.5 * excess * (1.0 + side * phi / std::hypot(phi, width)));
  };
  return {{"excess", excess, ""}, {"side", side, ""}};
}

}  // namespace

DisturbanceRow describe_asymmetric_spring() {
  return {.id = "asymmetric_spring",
          .says = "a spring stiffer by 0 to 10 % on one side",
          .kinds = {Rig::locked, Rig::free, Rig::specimen},
          .apply = apply};
}

}  // namespace flexspline::data
