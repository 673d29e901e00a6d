#include "flexspline/core/in_parallel.hpp"

#include <atomic>
#include <barrier>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace flexspline {
namespace {

TEST(InParallel, DoesEveryJobOnce) {
  for (const std::size_t threads : {0U, 1U, 2U, 7U}) {
    for (const std::size_t count : {0U, 1U, 3U, 100U}) {
      std::vector<std::atomic<int>> done(count);
      in_parallel(count, threads, [&](std::size_t i) { ++done[i]; });
      for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(done[i], 1) << i << " of " << count;
    }
  }
}

TEST(InParallel, ThrowsWhatAJobThrewAndBeginsNoOther) {
  std::atomic<int> done = 0;
  EXPECT_THROW(in_parallel(1000, 2,
                           [&](std::size_t i) {
                             if (i == 3) throw std::runtime_error("three");
                             ++done;
                           }),
               std::runtime_error);
  EXPECT_LT(done, 1000);
  int alone = 0;
  EXPECT_THROW(in_parallel(1000, 1,
                           [&](std::size_t i) {
                             if (i == 3) throw std::runtime_error("three");
                             ++alone;
                           }),
               std::runtime_error);
  EXPECT_EQ(alone, 3);
}

TEST(InParallel, ReturnsFromCallsWithinJobsAndBesideOneAnother) {
  std::atomic<int> done = 0;
  const auto nested = [&done] {
    in_parallel(8, 3, [&](std::size_t) {
      in_parallel(8, 3, [&](std::size_t) { in_parallel(5, 2, [&](std::size_t) { ++done; }); });
    });
  };
  {
    std::vector<std::jthread> callers;
    for (int k = 0; k < 4; ++k) callers.emplace_back(nested);
  }
  EXPECT_EQ(done, 4 * 8 * 8 * 5);
}

TEST(InParallel, HelpersAreOtherThreads) {
  // Two jobs that wait for each other end only when they run at the same time.
  std::barrier meet(2);
  in_parallel(2, 2, [&](std::size_t) { meet.arrive_and_wait(); });
}

}  // namespace
}  // namespace flexspline
