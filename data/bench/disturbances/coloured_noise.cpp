#include <algorithm>

#include "bench/hidden_draw.hpp"
#include "flexspline/data/hidden_bench.hpp"

namespace flexspline::data {
namespace {

std::vector<HiddenParameter> apply(HiddenBench& bench, std::uint64_t seed) {
  constexpr double kSamples[] = {4.0, 10.0, 20.0, 60.0};
  const double place = drawn(seed, "coloured_noise", 0, 0.0, 4.0);
  bench.nuisances.coloured_samples = kSamples[std::min(3, static_cast<int>(place))];
  bench.nuisances.coloured_share = drawn(seed, "coloured_noise", 1, 0.8, 1.0);
  return {{"samples", bench.nuisances.coloured_samples, ""},
          {"share", bench.nuisances.coloured_share, ""}};
}

}  // namespace

DisturbanceRow describe_coloured_noise() {
  return {.id = "coloured_noise",
          .says = "torque noise of first order, correlated over 4, 10, 20 or 60 samples",
          .kinds = {bench_kinds().begin(), bench_kinds().end()},
          .apply = apply};
}

}  // namespace flexspline::data
