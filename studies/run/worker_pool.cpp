#include "run/worker_pool.hpp"

#include <algorithm>

#include "flexspline/core/in_parallel.hpp"

namespace flexspline::studies {

bool run_tasks(const std::vector<std::function<bool()>>& tasks, int workers,
               const std::atomic<bool>* stop) {
  std::atomic<std::size_t> done = 0;
  std::atomic<bool> broken = false;
  in_parallel(tasks.size(), static_cast<std::size_t>(std::max(0, workers)), [&](std::size_t task) {
    if (broken || (stop != nullptr && *stop)) return;
    if (tasks[task]())
      ++done;
    else
      broken = true;
  });
  return done == tasks.size();
}

}  // namespace flexspline::studies
