#pragma once

#include <string>

#include <gtest/gtest.h>

#include "flexspline/studies/conceal.hpp"
#include "study_file.hpp"

namespace flexspline::studies {

/// A bench of two short recordings on the locked rig, and what it hides.
inline ConcealPlan small_plan(std::vector<data::HiddenEffect> effects, std::uint64_t seed = 5) {
  ConcealPlan plan;
  plan.seed = seed;
  plan.effects = std::move(effects);
  plan.design = {{data::HiddenMotion::sine, 4e-3, 0.05, 2.0, 200},
                 {data::HiddenMotion::multisine, 3e-3, 0.1, 2.0, 200}};
  return plan;
}

inline ConcealedCase concealed_case(const ConcealPlan& plan) {
  auto made = conceal(plan);
  EXPECT_TRUE(made.has_value()) << (made ? "" : made.error().message());
  return made ? *std::move(made) : ConcealedCase{};
}

}  // namespace flexspline::studies
