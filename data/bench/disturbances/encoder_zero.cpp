#include "bench/hidden_draw.hpp"
#include "flexspline/data/hidden_bench.hpp"

namespace flexspline::data {
namespace {

/// A servo's zero is where its arm hangs; on the others the torsion's.
std::vector<HiddenParameter> apply(HiddenBench& bench, std::uint64_t seed) {
  const bool arm = bench.rig == Rig::servo;
  const double share = drawn(seed, "encoder_zero", 0, -0.5, 0.5);
  const double most = arm ? 0.2 : bench.gear.rated_torsion;
  (arm ? bench.nuisances.load_zero : bench.nuisances.angle_zero) = share * most;
  return {{"zero", share * most, "rad"}};
}

}  // namespace

DisturbanceRow describe_encoder_zero() {
  return {.id = "encoder_zero",
          .says = "a zero of the torsion off by up to half its range, of a servo's arm by 0.1 rad",
          .kinds = {Rig::locked, Rig::free, Rig::specimen, Rig::servo},
          .apply = apply};
}

}  // namespace flexspline::data
