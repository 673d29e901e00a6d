#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "diagnosis_checks.hpp"
#include "flexspline/data/dataset.hpp"
#include "study_file.hpp"

namespace flexspline::studies {
namespace {

TEST(Diagnose, SaysNothingWasLeftOutWhereNothingWas) {
  for (const Bench& bench :
       {Bench{Rig::locked, 101, ""}, Bench{Rig::free, 103, ""}, Bench{Rig::specimen, 104, ""}}) {
    expect_nothing(bench);
  }
}

TEST(Diagnose, SaysWithoutANameWhatIsTooSmallForOne) {
  const auto bench = drawn_case(Rig::locked, 202, {{"presliding_hysteresis", 0.006}});
  const Diagnosis d = diagnosed(bench.recordings);
  EXPECT_EQ(d.verdict, Verdict::unexplained);
  EXPECT_TRUE(d.causes.empty());
  ASSERT_FALSE(d.mismatch.empty());
  EXPECT_EQ(d.mismatch.front().coordinate, "reversal_memory");
  EXPECT_NE(d.says.find("too little to be named"), std::string::npos) << d.says;
  EXPECT_EQ(d.says.find("presliding"), std::string::npos) << d.says;
}

// An unknown torque that no coordinate orders, with three times the mean square of the noise.
TEST(Diagnose, SaysThatSomethingIsLeftWhereNothingOrdersIt) {
  const auto bench = drawn_case(Rig::specimen, 405, {{"unknown:cross", 0.025}});
  const Diagnosis d = diagnosed(bench.recordings);
  EXPECT_EQ(d.verdict, Verdict::unexplained);
  EXPECT_TRUE(d.causes.empty());
  EXPECT_FALSE(d.unnamed) << "no table of it is proved on recordings held out";
}

// The same three times as large: a table over two coordinates shows it and says its law.
TEST(Diagnose, ShowsAsATableWhatHasNoName) {
  const auto bench = drawn_case(Rig::specimen, 405, {{"unknown:cross", 0.075}});
  const Diagnosis d = diagnosed(bench.recordings);
  EXPECT_EQ(d.verdict, Verdict::unexplained);
  EXPECT_TRUE(d.causes.empty());
  ASSERT_TRUE(d.unnamed);
  ASSERT_EQ(d.unnamed->axes.size(), 2U);
  EXPECT_EQ(d.unnamed->axes[0].coordinate, "velocity");
  EXPECT_EQ(d.unnamed->axes[1].coordinate, "torsion");
  EXPECT_NE(d.unnamed->proposed_equation.find(" w phi"), std::string::npos)
      << d.unnamed->proposed_equation;
  EXPECT_LT(d.unnamed->holdout_ratio, 0.8);
}

class DiagnoseVisible : public testing::TestWithParam<Bench> {};

TEST_P(DiagnoseVisible, EffectIsNamedFirstLocatedAndProved) { expect_found(GetParam()); }

INSTANTIATE_TEST_SUITE_P(AtSixPercent, DiagnoseVisible,
                         testing::Values(Bench{Rig::locked, 201, "inertia_torque"},
                                         Bench{Rig::locked, 202, "presliding_hysteresis"},
                                         Bench{Rig::locked, 208, "backlash"},
                                         Bench{Rig::free, 206, "gravity_load"}),
                         [](const auto& tested) { return tested.param.effect; });

/// A bench whose diagnosis is not to depend on words.
class DiagnoseWords : public testing::Test {
 protected:
  static const Said& plain() {
    static const Said said(diagnosed(set()));
    return said;
  }
  static const RecordingSet& set() {
    static const RecordingSet made =
        Bench{Rig::locked, 202, "presliding_hysteresis"}.make().recordings;
    return made;
  }
};

TEST_F(DiagnoseWords, TheSameAgain) { expect_same(plain(), Said(diagnosed(set())), 0.0); }

TEST_F(DiagnoseWords, NamesAndOrderSayNothing) {
  RecordingSet other = set();
  rename(other);
  std::ranges::reverse(other.recordings);
  expect_same(plain(), Said(diagnosed(other)), 1e-9);
}

/// Columns of a table in reverse.
void reverse_columns(const std::filesystem::path& file) {
  std::istringstream text(read_text(file));
  std::ofstream out(file);
  for (std::string line; std::getline(text, line);) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    for (std::size_t k = cells.size(); k > 0; --k) out << cells[k - 1] << (k > 1 ? "," : "\n");
  }
}

TEST_F(DiagnoseWords, TheOrderOfColumnsSaysNothing) {
  const ScratchFolder folder;
  ASSERT_TRUE(data::write_dataset(folder.path() / "set", set()).has_value());
  const auto plain = data::load_dataset(folder.path() / "set");
  ASSERT_TRUE(plain.has_value()) << plain.error().message();
  int tables = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path())) {
    if (entry.path().extension() != ".csv") continue;
    reverse_columns(entry.path());
    ++tables;
  }
  ASSERT_GT(tables, 0);
  const auto other = data::load_dataset(folder.path() / "set");
  ASSERT_TRUE(other.has_value()) << other.error().message();
  expect_same(Said(diagnosed(*plain)), Said(diagnosed(*other)), 0.0);
}

// In units whose conversion rounds every value anew.
TEST_F(DiagnoseWords, TheLastBitOfEveryValueSaysNothing) {
  RecordingSet other = set();
  for (Recording& recording : other.recordings) {
    for (auto& [quantity, values] : recording.channels) {
      for (double& value : values) value = value / 57.29577951308232 * 57.29577951308232;
    }
  }
  expect_same(plain(), Said(diagnosed(other)), 1e-3);
}

TEST(Diagnose, RefusesRecordingsWithoutATorqueAcrossTheTransmission) {
  RecordingSet set = drawn_case(Rig::locked, 101).recordings;
  for (Recording& r : set.recordings) r.channels.erase(Quantity::transmitted_torque);
  const auto result = diagnose(set);
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().code, ErrorCode::bad_data);
  EXPECT_NE(result.error().message().find("torque"), std::string::npos);
  EXPECT_NE(result.error().message().find(set.recordings.front().id.substr(0, 3)),
            std::string::npos);
}

TEST(Diagnose, RefusesASetOfNoRecordings) {
  RecordingSet set = drawn_case(Rig::locked, 101).recordings;
  set.recordings.clear();
  EXPECT_FALSE(diagnose(set).has_value());
}

TEST(Diagnose, TellsItsProgressInOrder) {
  std::vector<double> shares;
  const auto result =
      diagnose(drawn_case(Rig::specimen, 104).recordings, [&](double share, std::string_view says) {
        shares.push_back(share);
        EXPECT_FALSE(says.empty());
      });
  ASSERT_TRUE(result.has_value());
  EXPECT_TRUE(std::ranges::is_sorted(shares));
  EXPECT_EQ(shares.front(), 0.0);
  EXPECT_EQ(shares.back(), 1.0);
  EXPECT_GT(result->seconds, 0.0);
}

}  // namespace
}  // namespace flexspline::studies
