#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "dataset_fixture.hpp"
#include "flexspline/data/dataset.hpp"

namespace flexspline::data {
namespace {

class ThinRecordings : public InFolder {
 protected:
  void SetUp() override {
    InFolder::SetUp();
    std::string table = "t,theta,tau\n";
    for (int i = 0; i < kRows; ++i) {
      table +=
          std::to_string(i) + "," + std::to_string(i % 97) + "," + std::to_string(i % 89) + "\n";
    }
    put("a.csv", table);
    put("b.csv", sound_table());
    put("dataset.toml", kDescription + "[[recording]]\nid = \"b\"\nfile = \"b.csv\"\n");
  }

  static constexpr int kRows = 45001;
};

TEST_F(ThinRecordings, KeepEveryKthRowAndSaySo) {
  const auto set = load_dataset(folder_);
  ASSERT_TRUE(set.has_value()) << set.error().message();
  const Recording& thinned = set->recordings[0];
  ASSERT_EQ(thinned.time.size(), 15001U) << "every third, the first and the last among them";
  for (std::size_t i = 0; i < thinned.time.size(); i += 500) {
    EXPECT_EQ(thinned.time[i], static_cast<double>(3 * i));
    EXPECT_EQ(thinned.find(Quantity::transmitted_torque)->at(i), static_cast<double>(3 * i % 89));
  }
  EXPECT_EQ(set->recordings[1].time.size(), 16U);
  ASSERT_EQ(set->notes.size(), 1U);
  EXPECT_EQ(set->notes[0],
            "recording a: every 3rd of 45001 rows is used; --rows all uses them all");
}

// 4000 cycles of 50 rows: every tenth row would leave five of each.
TEST_F(ThinRecordings, FollowAFastMotionForAPartOfItsTime) {
  constexpr std::size_t kAll = 200'000;
  RecordingSet set;
  Recording fast;
  fast.id = "fast";
  std::vector<double> torsion, torque;
  for (std::size_t i = 0; i < kAll; ++i) {
    fast.time.push_back(1e-3 * static_cast<double>(i));
    torsion.push_back(std::sin(2.0 * std::numbers::pi * static_cast<double>(i) / 50.0));
    torque.push_back(static_cast<double>(i));
  }
  fast.channels = {{Quantity::torsion, torsion}, {Quantity::transmitted_torque, torque}};
  set.recordings = {fast};
  thin_recordings(set, 20'000);
  const Recording& thinned = set.recordings[0];
  EXPECT_EQ(thinned.time.size(), 20'000U);
  EXPECT_EQ(thinned.channels.at(Quantity::transmitted_torque)[1], 2.0) << "25 rows a cycle";
  EXPECT_EQ(set.notes[0],
            "recording fast: every 2nd of the first 40000 of 200000 rows is used: fewer would not "
            "follow the motion; --rows all uses them all");
}

TEST_F(ThinRecordings, AreWholeWhereAllRowsAreAskedFor) {
  const auto all = load_dataset(folder_, kAllRows);
  const auto some = load_dataset(folder_);
  ASSERT_TRUE(all && some);
  EXPECT_EQ(all->recordings[0].time.size(), static_cast<std::size_t>(kRows));
  EXPECT_TRUE(all->notes.empty());
  EXPECT_NE(all->sha256, some->sha256) << "what is fitted is not the same";
  EXPECT_EQ(some->sha256, content_hash(*some));
}

}  // namespace
}  // namespace flexspline::data
