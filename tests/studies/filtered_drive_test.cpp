// A locked drive whose every channel is behind the same low pass.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnosis_checks.hpp"
#include "drive_frame.hpp"

namespace flexspline::studies {
namespace {

Diagnosis of_a_filtered_drive(std::vector<data::HiddenEffect> effects) {
  ConcealPlan plan;
  plan.rig = Rig::locked;
  plan.seed = 20;
  plan.effects = std::move(effects);
  plan.disturbances = {"common_filter"};
  const auto hidden = conceal(plan);
  EXPECT_TRUE(hidden) << (hidden ? "" : hidden.error().message());
  return hidden ? diagnosed(hidden->recordings) : Diagnosis{};
}

// The motor's dry friction turns late behind it, as presliding does, and the motion as late.
TEST(FilteredDrive, HasNoHysteresisOfItsReversals) {
  const Diagnosis d = of_a_filtered_drive({});
  EXPECT_EQ(d.verdict, Verdict::adequate) << d.says;
  EXPECT_THAT(d.notes, testing::Contains(testing::HasSubstr("behind one filter")));
}

TEST(FilteredDrive, KeepsAHysteresisThatItHas) {
  const Diagnosis d = of_a_filtered_drive({{"presliding_hysteresis", 0.06}});
  EXPECT_THAT(names(d), testing::ElementsAre("presliding_hysteresis")) << d.says;
}

}  // namespace
}  // namespace flexspline::studies
