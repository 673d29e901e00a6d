// One simulation, one gradient and one fit of the base problem, by the program's own library.
#include <benchmark/benchmark.h>

#include <cmath>

#include "base_problem.hpp"
#include "flexspline/core/simulate.hpp"
#include "flexspline/estimators/method.hpp"
#include "torque_driven/driven_fit.hpp"
#include "torque_driven/integration_plan.hpp"

namespace flexspline::bench {
namespace {

using namespace estimators;

const DrivenProblem& base() {
  static const DrivenProblem problem =
      *driven_problem(base_records(), 3, 3, 2, InitialMotion::rest, 1);
  return problem;
}

void simulation(benchmark::State& state) {
  const auto threads = static_cast<std::size_t>(state.range(0));
  auto p = driven_start(base());
  IntegrationPlan plan(base(), p, best_instruction_set(), threads);
  for (auto _ : state) {
    p.front() = std::nextafter(p.front(), 1e3);  // the motions at the last p are remembered
    benchmark::DoNotOptimize(plan.states(p));
  }
}
BENCHMARK(simulation)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMicrosecond);

void gradient(benchmark::State& state) {
  const auto threads = static_cast<std::size_t>(state.range(0));
  const auto p = driven_start(base());
  IntegrationPlan plan(base(), p, best_instruction_set(), threads);
  for (auto _ : state) benchmark::DoNotOptimize(plan.stable_sums(p).normal.front());
}
BENCHMARK(gradient)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMicrosecond);

// How J'J grows: loops (steps squared), samples a loop, coefficients. One thread.
void growth(benchmark::State& state) {
  const auto at = [&state](std::size_t k) { return static_cast<int>(state.range(k)); };
  const auto problem =
      *driven_problem(base_records(at(0), at(1)), at(2), at(2), at(3), InitialMotion::rest, 1);
  const auto p = driven_start(problem);
  IntegrationPlan plan(problem, p, best_instruction_set(), 1);
  for (auto _ : state) benchmark::DoNotOptimize(plan.stable_sums(p).normal.front());
}
BENCHMARK(growth)
    ->Args({1, 1000, 3, 2})
    ->Args({2, 1000, 3, 2})
    ->Args({5, 1000, 3, 2})
    ->Args({10, 1000, 3, 2})
    ->Args({5, 250, 3, 2})
    ->Args({5, 4000, 3, 2})
    ->Args({5, 1000, 5, 3})
    ->Args({5, 1000, 10, 5})
    ->Unit(benchmark::kMicrosecond);

void fit(benchmark::State& state, const char* backend) {
  FitProblem problem{.records = base_records(), .options = {}};
  problem.options.numbers["threads"] = static_cast<double>(state.range(0));
  problem.options.words["backend"] = backend;
  const MethodRow& method = **find_method("torque_driven");
  for (auto _ : state) {
    const auto estimate = method.fit(problem);
    if (!estimate) state.SkipWithError(estimate.error().message().c_str());
  }
}
BENCHMARK_CAPTURE(fit, kernel, "kernel")
    ->Arg(1)
    ->Arg(2)
    ->UseRealTime()
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(fit, cvodes, "cvodes")->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fit, collocation, "collocation")
    ->Arg(1)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

// One record by the general path: laws of the catalogue, CVODES.
void general_simulation(benchmark::State& state) {
  const auto record = base_records()[12];
  const ModelSpec model{.f = {"odd_polynomial", 1.0, {}, {1.0, 0.5, 0.25}, 0.0},
                        .g_inverse = {"inverse_odd_polynomial", 1.0, {}, {8.0, 12.0, 20.0}, 0.0},
                        .h = {"exponential_modulation", 1.0, {}, {0.4, -0.15}, 0.0},
                        .effects = {}};
  for (auto _ : state) {
    benchmark::DoNotOptimize(simulate_torsion(model, record.time, record.effort, 0.0));
  }
}
BENCHMARK(general_simulation)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace flexspline::bench

BENCHMARK_MAIN();
