#include <fmt/format.h>
#include <gmock/gmock.h>

#include <numbers>

#include "dataset_fixture.hpp"
#include "flexspline/data/dataset.hpp"
#include "source_dir.hpp"

namespace flexspline::data {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr double kDegree = std::numbers::pi / 180.0;

class DatasetReadingTest : public InFolder {
 protected:
  RecordingSet read(const std::string& description, const std::string& table) {
    put("dataset.toml", description);
    put("a.csv", table);
    DatasetReading reading = read_dataset(folder_);
    for (const Finding& error : reading.errors) ADD_FAILURE() << error.message();
    notes_ = reading.notes;
    return reading.set.value_or(RecordingSet{});
  }

  std::vector<Finding> notes_;
};

void expect_sound(const RecordingSet& set) {
  ASSERT_EQ(set.recordings.size(), 1U);
  const Recording& recording = set.recordings[0];
  ASSERT_EQ(recording.time.size(), 16U);
  for (std::size_t i = 0; i < 16; ++i) {
    const auto n = static_cast<double>(i);
    EXPECT_EQ(recording.time[i], 0.5 * n);
    EXPECT_DOUBLE_EQ(recording.find(Quantity::motor_angle)->at(i), 2.0 * n * kDegree);
    EXPECT_EQ(recording.find(Quantity::transmitted_torque)->at(i), -n);
  }
}

TEST_F(DatasetReadingTest, GivesWhatTheFilesSayInSi) {
  const RecordingSet set = read(kDescription, sound_table());
  expect_sound(set);
  EXPECT_THAT(notes_, testing::IsEmpty());
  EXPECT_EQ(set.name, "bench");
  EXPECT_EQ(set.rig, Rig::locked);
  EXPECT_EQ(set.license, "CC0-1.0");
  EXPECT_EQ(set.constants.at("gear_ratio"), 50.0);
  EXPECT_EQ(set.display.motion, "deg");
  EXPECT_EQ(set.display.effort, "Nm");
  const Recording& recording = set.recordings[0];
  EXPECT_EQ(recording.id, "a");
  EXPECT_EQ(recording.excitation, "sine");
  EXPECT_DOUBLE_EQ(recording.amplitude.value(), 0.2 * kDegree);
  EXPECT_EQ(recording.frequency_hz, 0.5);
  EXPECT_EQ(recording.start_s, 0.0);
  EXPECT_EQ(recording.split, Split::unassigned);
}

TEST_F(DatasetReadingTest, TakesTablesAsBenchesLeaveThem) {
  expect_sound(read(kDescription, "\xEF\xBB\xBF" + sound_table()));
  expect_sound(read(kDescription, sound_table(',', "\r\n")));
  expect_sound(read(kDescription, sound_table() + "\n\r\n  \n"));
  expect_sound(read(kDescription, with(sound_table(), "t,theta,tau", "\"t\", \"theta\" ,tau ")));
  expect_sound(read(kDescription, with(sound_table(), "1.0,4,-2", " +1.0 ,\"4\",\t-2e0")));
  expect_sound(read(kDescription, sound_table('\t')));
  std::string unfinished = sound_table();
  unfinished.pop_back();
  expect_sound(read(kDescription, unfinished));
  EXPECT_THAT(notes_, testing::IsEmpty());
}

TEST_F(DatasetReadingTest, TakesSemicolonsWithDecimalCommasAndSaysSo) {
  std::string table = sound_table(';');
  for (char& letter : table) letter = letter == '.' ? ',' : letter;
  expect_sound(read(kDescription, table));
  ASSERT_EQ(notes_.size(), 1U);
  EXPECT_THAT(notes_[0].message(), HasSubstr("a.csv:1:1: the columns are separated by semicolons"));
}

TEST_F(DatasetReadingTest, NotesColumnsThatAreNoChannels) {
  std::string table = with(sound_table(), "t,", "remark,t,");
  for (std::size_t at = table.find('\n'); at + 1 < table.size(); at = table.find('\n', at + 1)) {
    table.insert(at + 1, "warm,");
  }
  expect_sound(read(kDescription, table));
  ASSERT_EQ(notes_.size(), 1U);
  EXPECT_THAT(notes_[0].message(), HasSubstr("ignored: column 'remark'"));
}

TEST_F(DatasetReadingTest, KeepsMetadataItDoesNotKnowOutOfTheWay) {
  const RecordingSet set =
      read(with(with(kDescription, "amplitude_deg = 0.2", "amplitude = 4.0\nfirmware_gain = 100"),
                "gear_ratio = 50",
                "gear_ratio = 50\noil_viscosity_Pas = 9007199254740993\ngear_rato = 3"),
           sound_table());
  EXPECT_FALSE(set.recordings.at(0).amplitude.has_value()) << "4.0 of what is not said";
  EXPECT_EQ(set.constants.at("oil_viscosity_Pas"), 9007199254740993.0);
  ASSERT_EQ(notes_.size(), 1U);
  EXPECT_THAT(notes_[0].message(), HasSubstr("dataset.toml:9:1: constant 'gear_rato' has no"));
}

TEST_F(DatasetReadingTest, ChecksumIsOfTheContentAlone) {
  const std::string sum = read(kDescription, sound_table()).sha256;
  EXPECT_EQ(sum.size(), 64U);
  EXPECT_EQ(read(with(kDescription, "name = \"bench\"", "name = \"x\"\nnote = \"y\""),
                 with(sound_table(), "1.0,4", "1.000,4.0"))
                .sha256,
            sum);
  EXPECT_EQ(
      read(with(kDescription, "t =", "clock ="), with(sound_table(), "t,theta", "clock,theta"))
          .sha256,
      sum);
  std::string in_arcmin = "theta,t,tau\n";
  for (int i = 0; i < 16; ++i) in_arcmin += fmt::format("{},{},{}\n", 120 * i, 0.5 * i, -i);
  EXPECT_EQ(read(with(kDescription, "unit = \"deg\"", "unit = \"arcmin\""), in_arcmin).sha256, sum);
  EXPECT_NE(read(kDescription, with(sound_table(), "1.0,4,", "1.0,4.00001,")).sha256, sum);
  EXPECT_NE(read(with(kDescription, "= 50", "= 51"), sound_table()).sha256, sum);
  EXPECT_NE(read(kDescription + "split = \"train\"\n", sound_table()).sha256, sum);
}

TEST_F(DatasetReadingTest, ReadsBackWhatItWrote) {
  RecordingSet set = read(kDescription + "split = \"holdout\"\nstart_s = 3\n", sound_table());
  Recording other = set.recordings[0];
  other.id = "b/\"odd\" name";
  other.amplitude.reset();
  other.channels[Quantity::motor_angle][3] = 0.1 + 0.2;
  set.recordings.push_back(other);
  set.source = "a \"quoted\" \\ source\nof two lines";
  ASSERT_TRUE(write_dataset(folder_ / "again", set).has_value());
  const DatasetReading reading = read_dataset(folder_ / "again");
  for (const Finding& finding : reading.errors) ADD_FAILURE() << finding.message();
  ASSERT_TRUE(reading.set.has_value());
  EXPECT_THAT(reading.notes, testing::IsEmpty());
  EXPECT_EQ(reading.set->source, set.source);
  EXPECT_EQ(reading.set->constants, set.constants);
  EXPECT_EQ(reading.set->display.motion, "deg");
  ASSERT_EQ(reading.set->recordings.size(), 2U);
  const Recording& back = reading.set->recordings[1];
  EXPECT_EQ(back.id, other.id);
  EXPECT_EQ(back.split, Split::holdout);
  EXPECT_EQ(back.start_s, 3.0);
  EXPECT_EQ(back.time, other.time);
  EXPECT_DOUBLE_EQ(back.find(Quantity::motor_angle)->at(3), 0.1 + 0.2);
  EXPECT_DOUBLE_EQ(reading.set->recordings[0].amplitude.value(), 0.2 * kDegree);
}

TEST_F(DatasetReadingTest, WritesNoSetThatTheFormatCannotHold) {
  RecordingSet set = read(kDescription, sound_table());
  set.recordings.push_back(set.recordings[0]);
  set.recordings[1].id = "b";
  set.recordings[1].channels.erase(Quantity::motor_angle);
  const auto written = write_dataset(folder_ / "again", set);
  ASSERT_FALSE(written.has_value());
  EXPECT_THAT(written.error().problem,
              HasSubstr("recording 'b' does not have the channels of 'a'"));
  EXPECT_FALSE(fs::exists(folder_ / "again"));
}

fs::path shared() { return fs::path(FLEXSPLINE_SOURCE_DIR) / ".." / "shared"; }

std::vector<fs::path> sets_in(const fs::path& folder) {
  std::vector<fs::path> sets;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (fs::exists(entry.path() / "dataset.toml")) sets.push_back(entry.path());
  }
  return sets;
}

TEST(RealRecordings, AllRead) {
  if (!fs::exists(shared() / "recordings")) GTEST_SKIP() << "the recordings folder is not here";
  const auto sets = sets_in(shared() / "recordings");
  EXPECT_GE(sets.size(), 9U);
  for (const fs::path& set : sets) {
    const auto loaded = load_dataset(set);
    EXPECT_TRUE(loaded.has_value()) << loaded.error().message();
  }
}

TEST(PracticeCases, AllRead) {
  if (!fs::exists(shared() / "practice")) GTEST_SKIP() << "the practice folder is not here";
  for (const fs::path& set : sets_in(shared() / "practice" / "cases")) {
    const auto loaded = load_dataset(set);
    EXPECT_TRUE(loaded.has_value()) << loaded.error().message();
  }
}

}  // namespace
}  // namespace flexspline::data
