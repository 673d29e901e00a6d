#include <cmath>
#include <numbers>

#include "bench/hidden_draw.hpp"
#include "flexspline/data/hidden_bench.hpp"

namespace flexspline::data {
namespace {

/// 10 to 13 bit on a motor, 12 to 15 on a servo's arm, 15 to 18 on a joint; else a hundredth of the
/// rated torsion and finer.
std::vector<HiddenParameter> apply(HiddenBench& bench, std::uint64_t seed) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const double finer = std::floor(drawn(seed, "coarse_encoders", 0, 0.0, 4.0));
  const double step = std::exp2(-finer);
  HiddenNuisances& n = bench.nuisances;
  if (bench.rig == Rig::specimen) {
    n.motor_encoder_step =
        step * (bench.travels ? kTurn / 0x1p15 : 0.01 * bench.gear.rated_torsion);
    return {{"step", n.motor_encoder_step, "rad"}};
  }
  n.motor_encoder_step = step * kTurn / 0x1p10;
  n.load_encoder_step =
      step * (bench.rig == Rig::servo ? kTurn / 0x1p12 : 0.01 * bench.gear.rated_torsion);
  return {{"motor_step", n.motor_encoder_step, "rad"}, {"load_step", n.load_encoder_step, "rad"}};
}

}  // namespace

DisturbanceRow describe_coarse_encoders() {
  return {.id = "coarse_encoders",
          .says = "encoders with few steps a turn, the torsion a hundred and more of them",
          .kinds = {bench_kinds().begin(), bench_kinds().end()},
          .apply = apply};
}

}  // namespace flexspline::data
