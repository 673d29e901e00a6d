// Which loop is recommended, against what theory says of one loop and of two.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "flexspline/data/dataset.hpp"
#include "flexspline/data/hidden_bench.hpp"
#include "flexspline/studies/next_loops.hpp"
#include "source_dir.hpp"

namespace flexspline::studies {
namespace {

RecordingSet recorded(std::vector<std::pair<double, double>> loops) {
  data::HiddenBench bench = data::draw_hidden_bench(Rig::locked, 21);
  const double rated = bench.gear.rated_torsion;
  bench.design.clear();
  for (const auto& [share, frequency] : loops) {
    bench.design.push_back({.motion = data::HiddenMotion::sine,
                            .amplitude = share * rated,
                            .frequency_hz = frequency,
                            .cycles = 3.0,
                            .samples = 600});
  }
  auto made = data::run_hidden_bench(bench, {});
  EXPECT_TRUE(made) << (made ? "" : made.error().message());
  return made ? std::move(made->measured) : RecordingSet{};
}

// One loop tells nothing of h; another frequency or amplitude is the remedy.
TEST(NextLoops, OfOneLoopOneMoreMakesHIdentifiable) {
  auto set = data::load_dataset(std::string(FLEXSPLINE_SOURCE_DIR) + "/docs/examples/locked-gear");
  ASSERT_TRUE(set) << set.error().message();
  std::erase_if(set->recordings, [](const Recording& one) { return one.id != "slow"; });
  const auto plan = plan_loops(*set);
  ASSERT_TRUE(plan) << plan.error().message();
  EXPECT_FALSE(plan->recorded.tells_h);
  ASSERT_FALSE(plan->candidates.empty());
  const LoopProspect& best = plan->candidates.front();
  SCOPED_TRACE(plan->says);
  EXPECT_TRUE(best.tells_h);
  EXPECT_GT(best.h_half_width, 0.0);
  for (std::size_t i = 1; i < plan->candidates.size(); ++i) {
    const LoopProspect& other = plan->candidates[i];
    if (other.tells_h && std::isfinite(other.h_half_width)) {
      EXPECT_GE(other.h_half_width, best.h_half_width);
    }
  }
}

TEST(NextLoops, RecordedLoopsAreNoCandidates) {
  const auto set = recorded({{1.0, 0.1}, {0.5, 0.2}});
  const auto plan = plan_loops(set);
  ASSERT_TRUE(plan) << plan.error().message();
  EXPECT_EQ(plan->candidates.size(), 14u) << "16 but for the two that are there";
}

TEST(NextLoops, AreRefusedWhereNoTorsionIsDriven) {
  RecordingSet set = recorded({{1.0, 0.1}});
  set.rig = Rig::free;
  const auto plan = plan_loops(set);
  ASSERT_FALSE(plan);
  EXPECT_THAT(plan.error().message(), testing::HasSubstr("follows from its load"));
}

}  // namespace
}  // namespace flexspline::studies
