// Ipopt on every certified problem; the valley of MGH10 takes it thousands of iterations.
#include <gtest/gtest.h>

#include "flexspline/estimators/certified.hpp"

namespace flexspline::estimators {
namespace {

TEST(CertifiedSlow, IpoptPassesEveryStart) {
  for (const auto* problem : certified_problems()) {
    for (std::size_t start = 0; start < problem->starts.size(); ++start) {
      const auto run = run_certified(*problem, start, Backend::ipopt);
      EXPECT_TRUE(run.passed()) << problem->id << " from start " << start + 1 << ": "
                                << run.judged_digits << " digits, " << name_of(run.termination)
                                << " " << run.failure;
    }
  }
}

}  // namespace
}  // namespace flexspline::estimators
