#include "solvers/processor_share.hpp"

#include <algorithm>
#include <atomic>

#include "flexspline/core/in_parallel.hpp"

namespace flexspline::estimators {
namespace {

std::atomic<std::size_t>& running_fits() {
  static std::atomic<std::size_t> count = 0;
  return count;
}

}  // namespace

ProcessorShare::ProcessorShare(std::size_t wanted) {
  const std::size_t running = ++running_fits();
  threads_ = wanted > 0 ? wanted : std::max<std::size_t>(1, threads_for(0) / running);
}

ProcessorShare::~ProcessorShare() { --running_fits(); }

}  // namespace flexspline::estimators
