// The table of what a baseline contains says what baselines do.
#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "trial/effect_trace.hpp"

namespace flexspline::studies {
namespace {

/// What the fitted baseline leaves of an effect of 6 %, over its size: the middle of five benches.
double left_of(const std::string& effect, Rig rig) {
  std::vector<double> left;
  for (std::uint64_t seed = 901; seed <= 905; ++seed) {
    ConcealPlan plan;
    plan.rig = rig;
    plan.seed = seed;
    plan.effects = {{effect, 0.06}};
    const auto concealed = conceal(plan);
    if (!concealed) continue;  // this bench cannot bring about the size
    const auto traces = traces_of(plan, concealed->recordings);
    EXPECT_TRUE(traces) << effect << " " << seed << ": " << traces.error().message();
    if (traces) left.push_back(traces->front().share / concealed->answer.effects[0].size_fraction);
  }
  EXPECT_GE(left.size(), 3U) << effect;
  std::ranges::sort(left);
  return left.empty() ? kNotComputed : left[left.size() / 2];
}

// A twentieth, and what the middle of five benches strays from that of all.
TEST(ContainedEffects, AreTakenUpByTheirBaselines) {
  for (const ContainedEffect& row : contained_effects()) {
    for (const Rig rig : row.rigs) {
      const std::string effect(row.effect);
      EXPECT_LT(left_of(effect, rig), 0.07) << effect << " on " << name_of(rig);
    }
  }
}

TEST(ContainedEffects, AreNotThoseThatLeaveMore) {
  EXPECT_GT(left_of("sensor_delay", Rig::specimen), 0.2);
  EXPECT_GT(left_of("inertia_torque", Rig::locked), 0.2);
  EXPECT_GT(left_of("stribeck_friction", Rig::servo), 0.2);
}

}  // namespace
}  // namespace flexspline::studies
