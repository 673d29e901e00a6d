#include "bench/hidden_draw.hpp"
#include "flexspline/data/hidden_bench.hpp"

namespace flexspline::data {
namespace {

std::vector<HiddenParameter> apply(HiddenBench& bench, std::uint64_t seed) {
  bench.nuisances.filter_samples = drawn(seed, "common_filter", 0, 0.6, 4.0);
  return {{"time_constant", bench.nuisances.filter_samples, "samples"}};
}

}  // namespace

DisturbanceRow describe_common_filter() {
  return {.id = "common_filter",
          .says = "every channel behind the same low pass, of 0.6 to 4 sampling intervals",
          .kinds = {bench_kinds().begin(), bench_kinds().end()},
          .apply = apply};
}

}  // namespace flexspline::data
