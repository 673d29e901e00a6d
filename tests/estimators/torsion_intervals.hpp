#pragma once

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "gears.hpp"

namespace flexspline::estimators {

/// A gear without h, fitted to four loops, with intervals of this kind.
inline Estimate with_intervals(const std::string& kind, const std::string& simulate,
                               double replicates) {
  const auto estimate =
      fitted("trajectory_ceres",
             four_loops(smooth_gear(), {.cycles = 2, .per_cycle = 100, .noise = 0.005}),
             {.numbers = {{"replicates", replicates}},
              .words = {{"uncertainty", kind}, {"simulate", simulate}, {"h", "unity"}}});
  EXPECT_TRUE(estimate) << estimate.error().message();
  return estimate ? *estimate : Estimate{};
}

inline bool is_free(const ParameterEstimate& p) { return !p.bound_active && std::isfinite(p.std); }

inline double width(const ParameterEstimate& p) { return p.ci95_upper - p.ci95_lower; }

}  // namespace flexspline::estimators
