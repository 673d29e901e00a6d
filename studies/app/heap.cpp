#include "heap.hpp"

#include <cstdlib>

#include "flexspline/core/in_parallel.hpp"

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace flexspline::app {

void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int kMiB = 1 << 20;
  mallopt(M_MMAP_THRESHOLD, 32 * kMiB);
  mallopt(M_TRIM_THRESHOLD, 256 * kMiB);
  mallopt(M_TOP_PAD, 16 * kMiB);
  // What one thread has freed, another takes: a sixth less memory in a search with folds.
  mallopt(M_ARENA_MAX, static_cast<int>(threads_for(0)));
#endif
}

}  // namespace flexspline::app
