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
  std::string_view instead;
  bool in_table;
  const char* place;  ///< "file:line:column"
  const char* words;
};

void PrintTo(const Refusal& refusal, std::ostream* out) { *out << refusal.name; }

class Refuses : public InFolder, public testing::WithParamInterface<Refusal> {};

TEST_P(Refuses, NamingThePlace) {
  const Refusal& bad = GetParam();
  put("dataset.toml",
      bad.in_table ? kDescription : with(kDescription, bad.piece, std::string(bad.instead)));
  put("a.csv",
      bad.in_table ? with(sound_table(), bad.piece, std::string(bad.instead)) : sound_table());
  put("b.csv", sound_table());
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
    {"channel_key", "unit = \"deg\"", "unit = \"deg\", scael = 2", false, "dataset.toml:11:51",
     "unknown key 'scael'; did you mean 'scale'?"},
    {"channel_sign", "unit = \"deg\"", "unit = \"deg\", sign = 2", false, "dataset.toml:11:58",
     "sign is 2; give 1 or -1"},
    {"channel_scale", "unit = \"deg\"", "unit = \"deg\", scale = -2", false, "dataset.toml:11:59",
     "scale is -2; give 1e-12 to 1e12; a direction belongs into sign"},
    {"channel_of_time", "unit = \"s\"", "unit = \"s\", sign = -1", false, "dataset.toml:10:45",
     "a time takes no sign"},
    {"counts_bare", "unit = \"deg\"", "unit = \"counts\"", false, "dataset.toml:11:9",
     "no 'counts_per_rev' here"},
    {"counts_of_none", "unit = \"deg\"", "unit = \"counts\", counts_per_rev = 0", false,
     "dataset.toml:11:71", "counts_per_rev is 0"},
    {"counts_unused", "unit = \"deg\"", "unit = \"deg\", counts_per_rev = 4096", false,
     "dataset.toml:11:68", "counts_per_rev beside the unit 'deg'"},
    {"counts_of_torque", "unit = \"Nm\"", "unit = \"counts\"", false, "dataset.toml:12:49",
     "unknown unit 'counts'"},
    {"inertia_sign", "gear_ratio = 50", "gear_ratio = 50\nmotor_inertia_kgm2 = -1", false,
     "dataset.toml:8:22", "motor_inertia_kgm2 is -1, which is not positive"},
    {"gear_ratio_huge", "= 50", "= 1e300", false, "dataset.toml:7:14",
     "gear_ratio is 1e+300, which is implausible (at most 1e+06)"},
    {"start_huge", "frequency_hz = 0.5", "start_s = 1e18", false, "dataset.toml:19:11",
     "start_s is 1e+18"},
    {"amplitude_huge", "amplitude_deg = 0.2", "amplitude_deg = 1e200", false, "dataset.toml:18:17",
     "values of dimension angle are at most 1e+09 rad"},
    {"channel_type", "{ quantity = \"time\", unit = \"s\" }", "\"s\"", false, "dataset.toml:10:5",
     "channel 't' is not a table"},
    {"quantity_twice", "[[recording]]", "x = { quantity = \"time\", unit = \"ms\" }\n[[recording]]",
     false, "dataset.toml:14:1", "columns 't' and 'x' are both the time"},
    {"rig_quantity", "tau = { quantity = \"transmitted_torque\"", "tau = { quantity = \"torque\"",
     false, "dataset.toml:9:1", "no channel is the transmitted_torque, which rig 'locked' needs"},
    {"id_absent", "id = \"a\"", "", false, "dataset.toml:14:1", "no 'id'"},
    {"id_empty", "id = \"a\"", "id = \"\"", false, "dataset.toml:15:6", "is empty"},
    {"id_twice", "frequency_hz = 0.5",
     "frequency_hz = 0.5\n[[recording]]\nid = \"a\"\nfile = \"b.csv\"", false, "dataset.toml:21:6",
     "two recordings have the id 'a', the other on line 15"},
    {"file_twice", "frequency_hz = 0.5",
     "frequency_hz = 0.5\n[[recording]]\nid = \"b\"\nfile = \"./a.csv\"", false,
     "dataset.toml:22:8", "two recordings have the file './a.csv', the other on line 16"},
    {"file_absent", "file = \"a.csv\"", "", false, "dataset.toml:14:1", "no 'file'"},
    {"file_missing", "\"a.csv\"", "\"c.csv\"", false, "dataset.toml:16:8",
     "file 'c.csv' is not there"},
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
    {"blank_row", "1.0,4,-2\n", "\n1.0,4,-2\n", true, "a.csv:4:1", "the line is empty"},
    {"implausible_angle", "1.0,4,", "1.0,1e200,", true, "a.csv:4:5",
     "column 'theta': 1e200 is implausible: values of dimension angle are at most 1e+09 rad"},
    {"implausible_torque", "1.0,4,-2", "1.0,4,-1e10", true, "a.csv:4:7",
     "at most 1e+09 Nm; correct the cell or the unit"},
    {"implausible_time", "7.5,30", "1e18,30", true, "a.csv:17:1", "at most 1e+11 s"},
    {"pause", "7.5,30", "7e5,30", true, "a.csv:17:1",
     "jumps by 7e+05 s, where all the rest lasts 7"},
    {"unit_row", "t,theta,tau\n", "t,theta,tau\n[s],[deg],[Nm]\n", true, "a.csv:2:1",
     "holds no numbers, '[s],[deg],[Nm]'; delete it; units are stated in [channels]"},
    {"comment_above", "t,theta,tau\n", "# bench 3\nt,theta,tau\n", true, "a.csv:1:1",
     "the first line is a comment, '# bench 3'; delete the lines above the names"},
    {"comment_within", "1.0,4,-2\n", "# pause\n1.0,4,-2\n", true, "a.csv:4:1",
     "the line is a comment, '# pause'; delete it"},
    {"no_names", "t,theta,tau\n", "", true, "a.csv:1:1", "the first line holds numbers"},
    {"blanks", "t,theta,tau", "t theta tau", true, "a.csv:1:1",
     "separated by blanks; separate names and numbers by commas"},
    {"spreadsheet_hint", "t,theta,tau\n", "sep=,\nt,theta,tau\n", true, "a.csv:1:1", "'sep='"},
    {"iso_time", "1.0,4,", "2024-05-03T10:00:01,4,", true, "a.csv:4:1",
     "column 't': '2024-05-03T10:00:01' is a date or time of day; write seconds"},
    {"number_with_unit", "1.0,4,", "1.0,4 deg,", true, "a.csv:4:5",
     "column 'theta': '4 deg' carries its unit; write the number alone"},
    {"nul", "t,theta", std::string_view("t,\0heta", 7), true, "a.csv:1:3", "NUL bytes"},
    {"carriage_returns", "t,theta,tau\n", "t,theta,tau\r0,0,0\r", true, "a.csv:1:12", "CR alone"},
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
