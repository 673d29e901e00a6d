#pragma once

#include <cstddef>
#include <functional>

namespace flexspline {

/// Threads to work with: wanted, or as many as processors where it is 0.
std::size_t threads_for(std::size_t wanted);

/// job(0), ..., job(count - 1), each once, in no order, by the caller and up to threads - 1 others
/// (0: as many threads as processors). Returns when all are done.
/// Errors: what a job throws is thrown on, the first of them, after the jobs that had begun; those
/// that had not are left out.
void in_parallel(std::size_t count, std::size_t threads,
                 const std::function<void(std::size_t)>& job);

}  // namespace flexspline
