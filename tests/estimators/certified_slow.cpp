// Ipopt on every certified problem; the valley of MGH10 takes it thousands of iterations.
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "flexspline/estimators/certified.hpp"
#include "solvers/least_squares.hpp"

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

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Starts of NIST's problems that do not end at the certified sum of squares with the floor of
/// damping that Ceres comes with.
template <class Solve>
std::vector<std::string> lost_with_the_usual_floor(const Solve& solve) {
  constexpr SolverSettings kUsualFloor{.max_iterations = 20000,
                                       .function_tolerance = 1e-17,
                                       .parameter_tolerance = 1e-17,
                                       .gradient_tolerance = 1e-30,
                                       .damping_floor = 1e-6};
  std::vector<std::string> lost;
  for (const auto* problem : certified_problems()) {
    if (problem->collection != "nist" || problem->id == "Lanczos1") continue;
    for (std::size_t start = 0; start < problem->starts.size(); ++start) {
      std::vector<BoundedParameter> parameters;
      for (const double value : problem->starts[start]) {
        parameters.push_back(
            {.start = value, .lower = -kInfinity, .upper = kInfinity, .scale = std::abs(value)});
      }
      const auto solution = solve(*problem->residuals, parameters, kUsualFloor);
      if (solution && correct_digits(2.0 * solution->cost, problem->sum_of_squares) > 4.0) continue;
      lost.push_back(fmt::format("{} {}", problem->id, start + 1));
    }
  }
  return lost;
}

TEST(CertifiedSlow, TheUsualFloorOfDampingLosesTheStartsThatThePageNames) {
  EXPECT_THAT(lost_with_the_usual_floor(minimise), testing::ElementsAre("BoxBOD 1"));
  EXPECT_THAT(lost_with_the_usual_floor(minimise_ipopt),
              testing::ElementsAre("Eckerle4 1", "MGH09 1", "MGH10 1", "MGH17 1", "Nelson 1"));
}

}  // namespace
}  // namespace flexspline::estimators
