#pragma once

#include <atomic>
#include <functional>
#include <vector>

namespace flexspline::studies {

/// Runs the tasks, in their order, on so many workers (0: as many as the machine has) until all are
/// done, one gives false, or stop becomes true; the tasks at hand are finished. False: not all ran.
bool run_tasks(const std::vector<std::function<bool()>>& tasks, int workers,
               const std::atomic<bool>* stop);

}  // namespace flexspline::studies
