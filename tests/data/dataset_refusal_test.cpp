#include <gmock/gmock.h>

#include <filesystem>

#include "dataset_fixture.hpp"
#include "flexspline/data/dataset.hpp"

namespace flexspline::data {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// One piece of a sound data set made bad, and what has to be said of it, where.
struct Refusal {
  const char* name;
  const char* piece;  ///< of the description, or of the table when in_table
  const char* instead;
  bool in_table;
  const char* place;  ///< "file:line:column"
  const char* words;
};

void PrintTo(const Refusal& refusal, std::ostream* out) { *out << refusal.name; }

class Refuses : public InFolder, public testing::WithParamInterface<Refusal> {};

TEST_P(Refuses, NamingThePlace) {
  const Refusal& bad = GetParam();
  put("dataset.toml", bad.in_table ? kDescription : with(kDescription, bad.piece, bad.instead));
  put("a.csv", bad.in_table ? with(sound_table(), bad.piece, bad.instead) : sound_table());
  const DatasetReading reading = read_dataset(folder_);
  EXPECT_FALSE(reading.set.has_value());
  ASSERT_EQ(reading.errors.size(), 1U)
      << (reading.errors.empty() ? "nothing" : reading.errors.back().message());
  const std::string message = reading.errors[0].message();
  EXPECT_THAT(message, HasSubstr((folder_ / bad.place).string() + ": "));
  EXPECT_THAT(message, HasSubstr(bad.words));
}

const Refusal kInDescription[] = {
    {"syntax", "gear_ratio = 50", "gear_ratio = = 50", false, "dataset.toml:7:14", "not TOML"},
    {"key_twice", "rig = \"locked\"", "name = \"x\"", false, "dataset.toml:3:8", "not TOML"},
    {"no_schema", "schema = \"flexspline-dataset/1\"", "", false, "dataset.toml:1:1", "'schema'"},
    {"schema", "dataset/1", "dataset/2", false, "dataset.toml:1:10",
     "unknown schema 'flexspline-dataset/2'; this version reads 'flexspline-dataset/1'"},
    {"rig", "\"locked\"", "\"lockd\"", false, "dataset.toml:3:7",
     "unknown rig 'lockd'; did you mean 'locked'?"},
    {"rig_type", "\"locked\"", "3", false, "dataset.toml:3:7", "rig is 3, of type integer"},
    {"key", "license", "licence", false, "dataset.toml:4:1", "did you mean 'license'?"},
    {"constant_type", "= 50", "= \"50\"", false, "dataset.toml:7:14", "give a number"},
    {"constant_nan", "= 50", "= nan", false, "dataset.toml:7:14", "not finite"},
    {"gear_ratio_sign", "= 50", "= -50", false, "dataset.toml:7:14", "gear_ratio is -50"},
    {"gear_ratio_missing", "gear_ratio = 50", "", false, "dataset.toml:6:1", "no gear_ratio"},
    {"quantity", "\"motor_angle\"", "\"motor_angel\"", false, "dataset.toml:11:22",
     "unknown quantity 'motor_angel'; did you mean 'motor_angle'?"},
    {"quantity_absent", "quantity = \"time\", ", "", false, "dataset.toml:10:5", "'quantity'"},
    {"unit", "unit = \"deg\"", "unit = \"degrees\"", false, "dataset.toml:11:44",
     "unknown unit 'degrees'; give one of: rad, mrad, urad, deg"},
    {"unit_absent", ", unit = \"deg\"", "", false, "dataset.toml:11:9", "no 'unit'"},
    {"dimension", "unit = \"deg\"", "unit = \"Nm\"", false, "dataset.toml:11:44",
     "unit 'Nm' is of dimension torque, but a motor_angle is of dimension angle"},
    {"channel_key", "unit = \"deg\"", "unit = \"deg\", scale = 2", false, "dataset.toml:11:51",
     "unknown key 'scale'"},
    {"channel_type", "{ quantity = \"time\", unit = \"s\" }", "\"s\"", false, "dataset.toml:10:5",
     "channel 't' is not a table"},
    {"quantity_twice", "[[recording]]", "x = { quantity = \"time\", unit = \"ms\" }\n[[recording]]",
     false, "dataset.toml:14:1", "columns 't' and 'x' are both the time"},
    {"rig_quantity", "tau = { quantity = \"transmitted_torque\"", "tau = { quantity = \"torque\"",
     false, "dataset.toml:9:1", "no channel is the transmitted_torque, which rig 'locked' needs"},
    {"id_absent", "id = \"a\"", "", false, "dataset.toml:14:1", "no 'id'"},
    {"id_empty", "id = \"a\"", "id = \"\"", false, "dataset.toml:15:6", "is empty"},
    {"id_twice", "frequency_hz = 0.5",
     "frequency_hz = 0.5\n[[recording]]\nid = \"a\"\nfile = \"a.csv\"", false, "dataset.toml:21:6",
     "two recordings have the id 'a', the other on line 15"},
    {"pass_without_start", "[[recording]]",
     "[[recording]]\nid = \"a\"\nfile = \"a.csv\"\nexcitation = \"sine\"\namplitude_deg = 0.2\n"
     "frequency_hz = 0.5\n[[recording]]",
     false, "dataset.toml:21:6", "two recordings have the id 'a', the other on line 15"},
    {"pass_of_another_file", "[[recording]]",
     "[[recording]]\nid = \"a\"\nfile = \"./a.csv\"\nexcitation = \"sine\"\n"
     "amplitude_deg = 0.2\nfrequency_hz = 0.5\nstart_s = 9\n[[recording]]",
     false, "dataset.toml:22:6", "two recordings have the id 'a', the other on line 15"},
    {"pass_at_another_rate", "[[recording]]",
     "[[recording]]\nid = \"a\"\nfile = \"a.csv\"\nexcitation = \"sine\"\namplitude_deg = 0.2\n"
     "frequency_hz = 0.6\nstart_s = 9\n[[recording]]",
     false, "dataset.toml:22:6", "two recordings have the id 'a', the other on line 15"},
    {"file_absent", "file = \"a.csv\"", "", false, "dataset.toml:14:1", "no 'file'"},
    {"file_missing", "\"a.csv\"", "\"b.csv\"", false, "dataset.toml:16:8",
     "file 'b.csv' is not there"},
    {"file_absolute", "\"a.csv\"", "\"/etc/hostname\"", false, "dataset.toml:16:8", "absolute"},
    {"file_climbs", "\"a.csv\"", "\"../a.csv\"", false, "dataset.toml:16:8",
     "climbs out of the folder"},
    {"file_climbs_late", "\"a.csv\"", "\"x/../../a.csv\"", false, "dataset.toml:16:8",
     "climbs out of the folder"},
    {"file_folder", "\"a.csv\"", "\".\"", false, "dataset.toml:16:8", "is not a file"},
    {"recording_key", "frequency_hz", "freqency_hz", false, "dataset.toml:19:1",
     "did you mean 'frequency_hz'?"},
    {"amplitude_unit", "amplitude_deg", "amplitude_dg", false, "dataset.toml:18:1",
     "unknown unit 'dg'"},
    {"amplitude_length", "amplitude_deg", "amplitude_mm", false, "dataset.toml:18:1",
     "dimension length"},
    {"frequency", "= 0.5", "= 0", false, "dataset.toml:19:16", "not positive"},
    {"split", "frequency_hz = 0.5", "split = \"hold-out\"", false, "dataset.toml:19:9",
     "did you mean 'holdout'?"},
};

const Refusal kInTable[] = {
    {"no_header", "t,theta,tau\n", "\n", true, "a.csv:1:1", "no header"},
    {"column", "theta", "thet", true, "a.csv:1:1",
     "no column 'theta', which line 11 of dataset.toml names as the motor_angle; did you mean "
     "'thet'?"},
    {"not_a_number", "1.0,4,", "1.0,four,", true, "a.csv:4:5", "column 'theta': 'four' is not a"},
    {"trailing_letters", "1.0,4,", "1.0,4x,", true, "a.csv:4:5", "'4x' is not a number"},
    {"empty_cell", "1.0,4,", "1.0,,", true, "a.csv:4:5", "'' is empty"},
    {"nan", "1.0,4,", "1.0,NaN,", true, "a.csv:4:5", "'NaN' is not finite"},
    {"infinity", "1.0,4,-2", "1.0,4,-inf", true, "a.csv:4:7", "'-inf' is not finite"},
    {"too_large", "1.0,4,", "1.0,1e999,", true, "a.csv:4:5", "too large"},
    {"time_repeats", "1.5,6", "1.0,6", true, "a.csv:5:1",
     "column 't' does not increase: 1 after 1"},
    {"time_returns", "7.5,30", "0.25,30", true, "a.csv:17:1", "0.25 after 7"},
    {"short_row", "1.0,4,-2", "1.0,4", true, "a.csv:4:5", "2 cells in a table of 3 columns"},
    {"long_row", "1.0,4,-2", "1.0,4,-2,9", true, "a.csv:4:10", "4 cells in a table of 3 columns"},
    {"decimal_comma", "1.0,4,-2", "1,0,4,1,-2,1", true, "a.csv:4:7", "decimal comma"},
    {"blank_row", "1.0,4,-2\n", "\n1.0,4,-2\n", true, "a.csv:4:1", "1 cells"},
    {"few_samples", "7.5,30,-15\n", "", true, "a.csv:16:1", "15 samples, where 16 are the fewest"},
    {"utf_16", "t,theta", "\xFF\xFEt,theta", true, "a.csv:1:1", "UTF-16"},
};

std::string name_of(const testing::TestParamInfo<Refusal>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(Description, Refuses, testing::ValuesIn(kInDescription), name_of);
INSTANTIATE_TEST_SUITE_P(Table, Refuses, testing::ValuesIn(kInTable), name_of);

class DatasetRefusal : public InFolder {};

TEST_F(DatasetRefusal, SaysEverythingAtOnce) {
  put("dataset.toml", with(with(kDescription, "\"locked\"", "\"lokced\""), "\"s\"", "\"N\""));
  EXPECT_EQ(read_dataset(folder_).errors.size(), 3U) << "rig, unit, and the missing table";
}

TEST_F(DatasetRefusal, SaysOfATableAllButCountsAfterTwenty) {
  put("dataset.toml", kDescription);
  std::string table = "t,theta,tau\n";
  for (int i = 0; i < 50; ++i) table += std::to_string(i) + ",x,0\n";
  put("a.csv", table);
  const auto errors = read_dataset(folder_).errors;
  ASSERT_EQ(errors.size(), 21U);
  EXPECT_EQ(errors[19].line, 21);
  EXPECT_THAT(errors[20].message(), HasSubstr("30 more errors"));
}

TEST_F(DatasetRefusal, OfAnEmptyTable) {
  put("dataset.toml", kDescription);
  put("a.csv", "");
  const auto errors = read_dataset(folder_).errors;
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_THAT(errors[0].message(), HasSubstr("a.csv:1:1: the table has no header"));
}

TEST_F(DatasetRefusal, OfAColumnThatStandsThereTwice) {
  put("dataset.toml", kDescription);
  std::string table = "t,theta,tau,tau\n";
  for (int i = 0; i < 16; ++i) table += std::to_string(i) + ",0,1,2\n";
  put("a.csv", table);
  const auto errors = read_dataset(folder_).errors;
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_THAT(errors[0].message(), HasSubstr("a.csv:1:13: column 'tau' stands here twice"));
}

TEST_F(DatasetRefusal, OfALinkThatLeavesTheFolder) {
  fs::create_directories(folder_ / "set");
  put("outside.csv", sound_table());
  put("set/dataset.toml", kDescription);
  fs::create_symlink("../outside.csv", folder_ / "set" / "a.csv");
  const auto errors = read_dataset(folder_ / "set").errors;
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_THAT(errors[0].message(), HasSubstr("dataset.toml:16:8: file 'a.csv' climbs out"));
  fs::remove(folder_ / "set" / "a.csv");
  put("set/inside.csv", sound_table());
  fs::create_symlink("inside.csv", folder_ / "set" / "a.csv");
  EXPECT_TRUE(read_dataset(folder_ / "set").set.has_value()) << "a link that stays is fine";
}

TEST_F(DatasetRefusal, OfWhatASpecimenAndAServoLack) {
  put("a.csv", sound_table());
  const auto first = [&](const std::string& rig, const std::string& motion) {
    put("dataset.toml", with(with(kDescription, "\"locked\"", '"' + rig + '"'), "\"motor_angle\"",
                             '"' + motion + '"'));
    const auto errors = read_dataset(folder_).errors;
    return errors.empty() ? "" : errors[0].message();
  };
  EXPECT_THAT(first("specimen", "motor_angle"), HasSubstr("one channel out of torsion, angle"));
  EXPECT_THAT(first("free", "motor_angle"), HasSubstr("no channel is the load_angle"));
  EXPECT_THAT(first("servo", "load_angle"), HasSubstr("needs what drives it"));
  EXPECT_EQ(first("specimen", "torsion"), "");
}

TEST_F(DatasetRefusal, IsAnErrorOfItsKindForCallersThatGoNoFurther) {
  const auto absent = load_dataset(folder_ / "absent");
  ASSERT_FALSE(absent.has_value());
  EXPECT_EQ(absent.error().code, ErrorCode::input_missing);
  put("dataset.toml", with(kDescription, "\"locked\"", "\"lockd\""));
  const auto bad = load_dataset(folder_);
  ASSERT_FALSE(bad.has_value());
  EXPECT_EQ(bad.error().code, ErrorCode::bad_data);
  EXPECT_THAT(bad.error().message(), HasSubstr("dataset.toml:3:7: unknown rig"));
  EXPECT_THAT(bad.error().message(), HasSubstr("'a.csv' is not there"));
}

}  // namespace
}  // namespace flexspline::data
