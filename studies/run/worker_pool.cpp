#include "run/worker_pool.hpp"

#include <algorithm>
#include <thread>

#include "flexspline/core/in_parallel.hpp"

namespace flexspline::studies {

bool run_tasks(const std::vector<std::function<bool()>>& tasks, int workers,
               const std::atomic<bool>* stop) {
  std::atomic<std::size_t> next = 0;
  std::atomic<std::size_t> done = 0;
  std::atomic<bool> broken = false;
  const auto work = [&] {
    while (!broken && !(stop != nullptr && *stop)) {
      const std::size_t task = next++;
      if (task >= tasks.size()) return;
      if (tasks[task]())
        ++done;
      else
        broken = true;
    }
  };
  const std::size_t wanted = threads_for(static_cast<std::size_t>(std::max(0, workers)));
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < std::min(wanted, tasks.size()); ++i) threads.emplace_back(work);
  }
  return done == tasks.size();
}

}  // namespace flexspline::studies
