#include "bench/hidden_draw.hpp"
#include "flexspline/data/hidden_bench.hpp"

namespace flexspline::data {
namespace {

std::vector<HiddenParameter> apply(HiddenBench& bench, std::uint64_t seed) {
  bench.nuisances.tail_degrees = static_cast<int>(drawn(seed, "heavy_tails", 0, 3.0, 6.0));
  return {{"degrees", static_cast<double>(bench.nuisances.tail_degrees), ""}};
}

}  // namespace

DisturbanceRow describe_heavy_tails() {
  return {.id = "heavy_tails",
          .says = "torque noise of Student's t with 3 to 5 degrees of freedom, of the same rms",
          .kinds = {bench_kinds().begin(), bench_kinds().end()},
          .apply = apply};
}

}  // namespace flexspline::data
