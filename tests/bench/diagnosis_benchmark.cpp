// One diagnosis, from recordings to verdict, of a drawn bench that hides nothing, and of one that
// hides presliding hysteresis.
#include <benchmark/benchmark.h>

#include "flexspline/studies/conceal.hpp"
#include "flexspline/studies/diagnosis.hpp"

namespace flexspline::bench {
namespace {

void diagnosis(benchmark::State& state, Rig rig, std::vector<data::HiddenEffect> effects) {
  studies::ConcealPlan plan;
  plan.rig = rig;
  plan.seed = 202;
  plan.effects = std::move(effects);
  const auto hidden = studies::conceal(plan);
  if (!hidden) return state.SkipWithError(hidden.error().message().c_str());
  for (auto _ : state) {
    const auto diagnosed = studies::diagnose(hidden->recordings, {}, {.nested = false});
    if (!diagnosed) state.SkipWithError(diagnosed.error().message().c_str());
  }
}

const std::vector<data::HiddenEffect> kHysteresis = {{"presliding_hysteresis", 0.06}};

BENCHMARK_CAPTURE(diagnosis, locked_nothing, Rig::locked, {})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(diagnosis, locked_hysteresis, Rig::locked, kHysteresis)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(diagnosis, free_nothing, Rig::free, {})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(diagnosis, free_hysteresis, Rig::free, kHysteresis)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace flexspline::bench
