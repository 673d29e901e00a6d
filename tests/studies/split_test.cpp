#include <algorithm>

#include <gtest/gtest.h>

#include "flexspline/studies/plan.hpp"

namespace flexspline::studies {
namespace {

std::vector<TorsionRecord> records(const std::vector<double>& ranges) {
  std::vector<TorsionRecord> list;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    TorsionRecord record;
    record.id = "r" + std::to_string(i);
    record.motion = {0.0, ranges[i]};
    record.valid = {true, true};
    list.push_back(record);
  }
  return list;
}

std::vector<std::string> held_out(const std::vector<TorsionRecord>& list) {
  std::vector<std::string> ids;
  for (const TorsionRecord& record : list) {
    if (record.split == Split::holdout) ids.push_back(record.id);
  }
  return ids;
}

using Ids = std::vector<std::string>;

TEST(Split, OneRecordingIsTrainedOn) {
  auto list = records({1.0});
  EXPECT_NE(split_recordings(list).find("none to hold out"), std::string::npos);
  EXPECT_EQ(list[0].split, Split::train);
}

TEST(Split, OfTwoTheSmallerIsHeldOut) {
  auto list = records({1.0, 2.0});
  split_recordings(list);
  EXPECT_EQ(held_out(list), Ids{"r0"});
}

TEST(Split, AboutOneInThreeAndNeverTheExtremes) {
  for (std::size_t n = 3; n <= 30; ++n) {
    std::vector<double> ranges;
    for (std::size_t i = 0; i < n; ++i) ranges.push_back(1.0 + static_cast<double>((i * 37) % n));
    auto list = records(ranges);
    split_recordings(list);
    const auto held = static_cast<double>(held_out(list).size());
    EXPECT_NEAR(held, static_cast<double>(n) / 3.0, 0.51) << n;
    for (const TorsionRecord& record : list) {
      if (record.split != Split::holdout) continue;
      EXPECT_GT(record.motion[1], *std::min_element(ranges.begin(), ranges.end())) << n;
      EXPECT_LT(record.motion[1], *std::max_element(ranges.begin(), ranges.end())) << n;
    }
  }
}

TEST(Split, OrderOfTheFilesDoesNotMatter) {
  auto list = records({5.0, 1.0, 3.0, 2.0, 4.0, 6.0});
  auto reversed = list;
  std::reverse(reversed.begin(), reversed.end());
  split_recordings(list);
  split_recordings(reversed);
  auto ids = held_out(reversed);
  std::reverse(ids.begin(), ids.end());
  EXPECT_EQ(held_out(list), ids);
}

TEST(Split, MarkedTrainingHoldsOutEverythingElse) {
  auto list = records({1.0, 2.0, 3.0});
  list[1].split = Split::train;
  split_recordings(list);
  EXPECT_EQ(held_out(list), (Ids{"r0", "r2"}));
}

TEST(Split, MarkedHoldOutStaysSo) {
  auto list = records({1.0, 2.0, 3.0, 9.0});
  list[3].split = Split::holdout;
  split_recordings(list);
  EXPECT_EQ(held_out(list), (Ids{"r1", "r3"}));
}

TEST(Split, SpoiledSamplesDoNotCountAsMotion) {
  auto list = records({1.0, 2.0});
  list[0].motion.push_back(50.0);
  list[0].valid.push_back(false);
  split_recordings(list);
  EXPECT_EQ(held_out(list), Ids{"r0"});
}

}  // namespace
}  // namespace flexspline::studies
