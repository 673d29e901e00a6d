#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dataset_fixture.hpp"
#include "flexspline/data/dataset.hpp"
#include "flexspline/data/import.hpp"
#include "source_dir.hpp"

namespace flexspline::data {
namespace {

using ::testing::HasSubstr;

std::string said(const ImportPlan& plan) {
  std::string text;
  for (const Inference& one : plan.inferred) {
    text += fmt::format("{} ({}: {})\n", one.what, name_of(one.certainty), one.evidence);
  }
  for (const std::string& note : plan.notes) text += "note: " + note + "\n";
  for (const OpenQuestion& one : plan.open) {
    text += "open: " + one.problem + "; " + one.remedy + "\n";
  }
  return text;
}

/// Files of the corpus whose channels lie in tables of their own; its numbers are those of
/// corpus.py.
class ImportJoin : public InFolder {
 protected:
  ImportWish wish(const std::string& file) const {
    ImportWish one;
    one.files = {std::string(FLEXSPLINE_SOURCE_DIR) + "/tests/data/corpus/files/" + file};
    one.constants["gear_ratio"] = 50;
    one.name = "joined";
    return one;
  }

  RecordingSet written(const ImportPlan& plan, std::string& notes) const {
    const auto done = write_import(plan, folder_ / "set");
    EXPECT_TRUE(done) << done.error().message();
    for (const std::string& note : done->notes) notes += note + "\n";
    const auto reading = read_dataset(folder_ / "set");
    for (const Finding& one : reading.errors) ADD_FAILURE() << one.message();
    return reading.set.value_or(RecordingSet{});
  }
};

double theta(int i) { return std::round(1e3 * 400.0 * std::sin(0.3 * i)) / 1e3; }
double tau(int i) { return std::round(1e4 * 25.5 * std::sin(0.3 * i + 0.2)) / 1e4; }

TEST_F(ImportJoin, TwoRatesMeetAtTheInstantsOfTheSlowest) {
  const auto plan = plan_import(wish("two_rates.mf4"));
  ASSERT_TRUE(plan) << plan.error().message();
  ASSERT_TRUE(plan->open.empty()) << said(*plan);
  EXPECT_EQ(plan->rig, Rig::locked);
  EXPECT_THAT(said(*plan),
              HasSubstr("at the instants of the slowest of 'encoder' (100 Hz), 'sensor' "
                        "(50 Hz) (likely: "));
  std::string notes;
  const RecordingSet set = written(*plan, notes);
  EXPECT_THAT(notes, HasSubstr("20 of 20 rows lie between samples of the other tables"));
  ASSERT_EQ(set.recordings.size(), 1U);
  const Recording& one = set.recordings[0];
  ASSERT_EQ(one.time.size(), 20U);
  for (int k = 0; k < 20; ++k) {
    const auto at = static_cast<std::size_t>(k);
    EXPECT_NEAR(one.time[at], 0.02 * k + 0.005, 1e-12);
    EXPECT_NEAR(one.find(Quantity::transmitted_torque)->at(at), tau(2 * k), 2e-6);
    EXPECT_NEAR(one.find(Quantity::motor_angle)->at(at),
                std::numbers::pi / 180 * 0.5 * (theta(2 * k) + theta(2 * k + 1)), 1e-6);
  }
}

TEST_F(ImportJoin, TwoTopicsWithSharedStampsKeepEveryValue) {
  const auto plan = plan_import(wish("two_topics.mcap"));
  ASSERT_TRUE(plan) << plan.error().message();
  ASSERT_TRUE(plan->open.empty()) << said(*plan);
  EXPECT_EQ(plan->rig, Rig::locked);
  EXPECT_THAT(said(*plan), HasSubstr("of 3 such the only one that changes"));
  std::string notes;
  const RecordingSet set = written(*plan, notes);
  EXPECT_EQ(notes.find("between samples"), notes.npos) << notes;
  ASSERT_EQ(set.recordings.size(), 1U);
  const Recording& one = set.recordings[0];
  ASSERT_EQ(one.time.size(), 20U);
  for (std::size_t k = 0; k < 20; ++k) {
    EXPECT_DOUBLE_EQ(one.find(Quantity::motor_angle)->at(k), theta(2 * static_cast<int>(k)));
    EXPECT_DOUBLE_EQ(one.find(Quantity::transmitted_torque)->at(k), tau(2 * static_cast<int>(k)));
  }
}

TEST_F(ImportJoin, IsNotDoneWhereOneTableHasAllThatIsNeeded) {
  const auto plan =
      plan_import(wish("unsorted.mf4"));  // a temperature beside it, four times as slow
  ASSERT_TRUE(plan) << plan.error().message();
  EXPECT_TRUE(plan->open.empty()) << said(*plan);
  EXPECT_EQ(said(*plan).find("instants of the slowest"), std::string::npos) << said(*plan);
}

TEST_F(ImportJoin, IsStatedWhereNamesTellNothing) {
  ImportWish from = wish("two_rates.mf4");
  from.constants.clear();
  from.rig = Rig::free;
  const auto apart = plan_import(from);
  ASSERT_TRUE(apart);
  EXPECT_THAT(said(*apart), HasSubstr("--join"));
  from.join = true;
  const auto plan = plan_import(from);
  ASSERT_TRUE(plan);
  EXPECT_THAT(said(*plan), HasSubstr("(stated: by --join)"));
  EXPECT_THAT(said(*plan), HasSubstr("table 'sensor + encoder': no column is the load_angle"));
}

}  // namespace
}  // namespace flexspline::data
