// The base fit, once, on one thread: what callgrind counts the instructions of.
#include <cstdio>

#include "base_problem.hpp"
#include "flexspline/estimators/method.hpp"

namespace {

using namespace flexspline;
using namespace flexspline::estimators;

// Apart and by this name, for callgrind's --toggle-collect.
[[gnu::noinline]] Result<Estimate> counted_base_fit(const FitProblem& problem) {
  return (*find_method("torque_driven"))->fit(problem);
}

}  // namespace

int main() {
  FitProblem problem{.records = bench::base_records(), .options = {}};
  problem.options.numbers["threads"] = 1.0;
  const auto estimate = counted_base_fit(problem);
  if (!estimate) {
    std::fputs(estimate.error().message().c_str(), stderr);
    return 1;
  }
  std::printf("%d evaluations, cost %.9g\n", static_cast<int>(estimate->evaluations),
              estimate->cost);
  return 0;
}
