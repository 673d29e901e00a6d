#include "flexspline/core/in_parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <vector>

namespace flexspline {
namespace {

// Asked once: the system reads a file for it.
std::size_t processors() {
  static const std::size_t count = std::max(1U, std::thread::hardware_concurrency());
  return count;
}

}  // namespace

std::size_t threads_for(std::size_t wanted) { return wanted > 0 ? wanted : processors(); }

void in_parallel(std::size_t count, std::size_t threads,
                 const std::function<void(std::size_t)>& job) {
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> thrown = false;
  std::exception_ptr first;
  const auto work = [&] {
    try {
      for (std::size_t i = next++; i < count; i = next++) job(i);
    } catch (...) {
      next = count;
      if (!thrown.exchange(true)) first = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> others;
    const std::size_t all = std::min(threads_for(threads), count);
    for (std::size_t k = 1; k < all; ++k) others.emplace_back(work);
    work();
  }
  if (first) std::rethrow_exception(first);
}

}  // namespace flexspline
