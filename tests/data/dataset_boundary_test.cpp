#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "dataset_fixture.hpp"
#include "flexspline/data/dataset.hpp"

namespace flexspline::data {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr double kDegree = std::numbers::pi / 180.0;

/// A table of n rows by a rule for the cells of row i.
std::string table_of(const std::string& header, int n, const std::function<std::string(int)>& row) {
  std::string text = header + "\n";
  for (int i = 0; i < n; ++i) text += row(i) + "\n";
  return text;
}

const std::string kWithValid = with(kDescription, "[[recording]]",
                                    "ok = { quantity = \"valid\", unit = \"1\" }\n[[recording]]");

class DatasetBoundary : public InFolder {
 protected:
  DatasetReading read(const std::string& description, const std::string& table) {
    put("dataset.toml", description);
    put("a.csv", table);
    return read_dataset(folder_);
  }
  /// The one error of a reading that has to be refused.
  static std::string error_of(const DatasetReading& reading) {
    EXPECT_FALSE(reading.set.has_value());
    EXPECT_EQ(reading.errors.size(), 1U);
    return reading.errors.empty() ? "" : reading.errors.front().message();
  }
  /// The one note of a reading that has to be accepted.
  static std::string note_of(const DatasetReading& reading) {
    for (const Finding& error : reading.errors) ADD_FAILURE() << error.message();
    EXPECT_EQ(reading.notes.size(), 1U);
    return reading.notes.empty() ? "" : reading.notes.front().message();
  }
};

TEST_F(DatasetBoundary, RefusesAConstantChannelThatTheRigNeeds) {
  for (const char* angle : {"0", "12.5"}) {
    const auto still = table_of("t,theta,tau", 40,
                                [&](int i) { return fmt::format("{},{},{}", i, angle, i % 7); });
    EXPECT_THAT(error_of(read(kDescription, still)),
                HasSubstr("a.csv: column 'theta', the motor_angle, is constant"));
  }
  const auto frozen =
      table_of("t,theta,tau", 40, [](int i) { return fmt::format("{},{},0.1", i, i % 7); });
  EXPECT_THAT(error_of(read(kDescription, frozen)),
              HasSubstr("column 'tau', the transmitted_torque, is constant"));
  const auto vanishing = table_of(
      "t,theta,tau", 40, [](int i) { return fmt::format("{},{},{}e-310", i, i % 7, i % 5); });
  EXPECT_THAT(error_of(read(kDescription, vanishing)), HasSubstr("is constant"));
  const auto only_where_spoiled = table_of("t,theta,tau,ok", 40, [](int i) {
    return fmt::format("{},{},{},{}", i, i < 20 ? 0 : i, i % 5, i < 20 ? 1 : 0);
  });
  EXPECT_THAT(error_of(read(kWithValid, only_where_spoiled)), HasSubstr("'theta'"));
}

TEST_F(DatasetBoundary, TakesChannelsThatMayBeConstant) {
  const std::string servo =
      "schema = \"flexspline-dataset/1\"\nname = \"s\"\nrig = \"servo\"\nlicense = \"CC0-1.0\"\n"
      "[channels]\n"
      "t = { quantity = \"time\", unit = \"s\" }\n"
      "q = { quantity = \"load_angle\", unit = \"rad\" }\n"
      "d = { quantity = \"duty_cycle\", unit = \"1\" }\n"
      "v = { quantity = \"supply_voltage\", unit = \"V\" }\n"
      "on = { quantity = \"drive_enabled\", unit = \"1\" }\n"
      "T = { quantity = \"temperature\", unit = \"degC\" }\n"
      "[[recording]]\nid = \"a\"\nfile = \"a.csv\"\n";
  const auto falling = table_of("t,q,d,v,on,T", 40, [](int i) {
    return fmt::format("{},{},0,7.4,0,25", 0.01 * i, std::cos(0.1 * i));
  });
  EXPECT_TRUE(read(servo, falling).errors.empty()) << "a free fall with the drive off";
}

TEST_F(DatasetBoundary, RefusesRecordingsWithoutEnoughValidSamples) {
  for (const int valid : {0, 15}) {
    const auto table = table_of("t,theta,tau,ok", 40, [&](int i) {
      return fmt::format("{},{},{},{}", i, i % 7, i % 5, i < valid ? 1 : 0);
    });
    EXPECT_THAT(
        error_of(read(kWithValid, table)),
        HasSubstr(fmt::format("{} of 40 samples are valid by column 'ok', where 16", valid)));
  }
}

TEST_F(DatasetBoundary, RefusesMarksThatAreNeitherYesNorNo) {
  const auto table = table_of("t,theta,tau,ok", 40, [](int i) {
    return fmt::format("{},{},{},{}", i, i % 7, i % 5, i == 3 ? 7 : 1);
  });
  EXPECT_THAT(error_of(read(kWithValid, table)),
              HasSubstr("a.csv:5:7: column 'ok': 7 is neither 0 nor 1"));
}

TEST_F(DatasetBoundary, FillsDropoutsStraightBetweenTheirNeighbours) {
  const char* const nothing[] = {"", "NaN", "nan", "inf", "NA", "1e30"};
  const auto table = table_of("t,theta,tau,ok", 40, [&](int i) {
    const bool out = i >= 10 && i < 16;
    const std::string angle = out ? nothing[i - 10] : fmt::format("{}", i * i);
    return fmt::format("{},{},{},{}", i < 12 ? i : i + 1, angle, i % 5, out ? 0 : 1);
  });
  const DatasetReading reading = read(kWithValid, table);
  EXPECT_THAT(note_of(reading),
              HasSubstr("column 'theta' drops out in 6 of 40 samples, where valid is 0"));
  ASSERT_TRUE(reading.set.has_value());
  ASSERT_EQ(reading.set->notes.size(), 1U);
  EXPECT_THAT(reading.set->notes[0], HasSubstr("recording a: column 'theta' drops out"));
  const Recording& recording = reading.set->recordings[0];
  for (std::size_t i = 10; i < 16; ++i) {
    const double share = (recording.time[i] - 9.0) / (17.0 - 9.0);
    EXPECT_NEAR(recording.find(Quantity::motor_angle)->at(i) / kDegree, 81 + share * (256 - 81),
                1e-10);
  }
  EXPECT_DOUBLE_EQ(recording.find(Quantity::motor_angle)->at(16), 256 * kDegree);
}

TEST_F(DatasetBoundary, HoldsTheNearestValueWhereADropoutReachesTheEnd) {
  const auto table = table_of("t,theta,tau,ok", 40, [](int i) {
    const bool out = i < 3 || i > 36;
    return fmt::format("{},{},{},{}", i, out ? "" : fmt::format("{}", i), i % 5, out ? 0 : 1);
  });
  const DatasetReading reading = read(kWithValid, table);
  ASSERT_TRUE(reading.set.has_value());
  const auto& angle = *reading.set->recordings[0].find(Quantity::motor_angle);
  EXPECT_DOUBLE_EQ(angle.front(), 3 * kDegree);
  EXPECT_DOUBLE_EQ(angle.back(), 36 * kDegree);
}

TEST_F(DatasetBoundary, RefusesADropoutThatNothingMarksAndOneOfTime) {
  const auto unmarked = table_of("t,theta,tau,ok", 40, [](int i) {
    return fmt::format("{},{},{},1", i, i == 3 ? "" : fmt::format("{}", i), i % 5);
  });
  EXPECT_THAT(error_of(read(kWithValid, unmarked)), HasSubstr("a.csv:5:3: column 'theta': ''"));
  const auto of_time = table_of("t,theta,tau,ok", 40, [](int i) {
    return fmt::format("{},{},{},{}", i == 3 ? "" : fmt::format("{}", i), i, i % 5, i == 3 ? 0 : 1);
  });
  EXPECT_THAT(error_of(read(kWithValid, of_time)), HasSubstr("a.csv:5:1: column 't': ''"));
}

TEST_F(DatasetBoundary, AppliesSignScaleOffsetAndCountsInThisOrder) {
  std::string description =
      with(kDescription, "unit = \"deg\" }",
           "unit = \"counts\", counts_per_rev = 4096, sign = -1, offset = 8 }");
  description = with(description, "unit = \"Nm\" }",
                     "unit = \"mNm\", sign = -1, scale = 4.0, offset = 500.0 }");
  description = with(description, "unit = \"s\" }", "unit = \"ms\", offset = 250, scale = 2 }");
  const auto table = table_of(
      "t,theta,tau", 40, [](int i) { return fmt::format("{},{},{}", 100 * i, 128 * i, 1000 * i); });
  const DatasetReading reading = read(description, table);
  ASSERT_TRUE(reading.set.has_value());
  const Recording& recording = reading.set->recordings[0];
  for (std::size_t i = 0; i < 40; ++i) {
    const auto n = static_cast<double>(i);
    EXPECT_NEAR(recording.time[i], 0.2 * n + 0.25, 1e-12);
    EXPECT_NEAR(recording.find(Quantity::motor_angle)->at(i),
                (8.0 - 128.0 * n) / 4096.0 * 2.0 * std::numbers::pi, 1e-12);
    EXPECT_NEAR(recording.find(Quantity::transmitted_torque)->at(i), -4.0 * n + 0.5, 1e-12);
  }
}

TEST_F(DatasetBoundary, ShowsASpecimenInCountsInDegrees) {
  std::string description = with(kDescription, "\"locked\"", "\"specimen\"");
  description = with(description, "\"motor_angle\", unit = \"deg\"",
                     "\"torsion\", unit = \"counts\", counts_per_rev = 1000");
  const DatasetReading reading = read(description, sound_table());
  ASSERT_TRUE(reading.set.has_value());
  EXPECT_EQ(reading.set->display.motion, "deg");
}

TEST_F(DatasetBoundary, ReadsUnitsAsBenchesWriteThem) {
  const auto torque_of = [&](const std::string& unit) {
    const DatasetReading reading = read(
        with(with(kDescription, "\"Nm\"", '"' + unit + '"'), "\"deg\"", "\"°\""), sound_table());
    EXPECT_TRUE(reading.set.has_value()) << unit;
    return reading.set ? reading.set->recordings[0].find(Quantity::transmitted_torque)->at(1) : 0.0;
  };
  for (const char* unit : {"Nm", "N.m", "N·m", "N m", "N*m"}) EXPECT_EQ(torque_of(unit), -1.0);
  EXPECT_EQ(torque_of("mN·m"), -1e-3);
  EXPECT_NEAR(torque_of("in-lb"), -0.1129848290276167, 1e-15);  // NIST SP 811, B.8
  EXPECT_NEAR(torque_of("ft-lb"), -1.3558179483314004, 1e-14);
}

TEST_F(DatasetBoundary, ReadsALatin1HeaderAndSaysSo) {
  const std::string table = with(sound_table(), "t,theta,tau", "t,Winkel [\xB0],tau");
  const DatasetReading reading = read(with(kDescription, "\ntheta =", "\n\"Winkel [°]\" ="), table);
  EXPECT_THAT(note_of(reading),
              HasSubstr("a.csv:1:1: the header is not UTF-8; it is read as Latin-1"));
}

TEST_F(DatasetBoundary, SaysCellsOfAnyBytesInUtf8) {
  const std::string cell = "\xB0\x01" + std::string(100, 'x');
  const std::string message =
      error_of(read(kDescription, with(sound_table(), "1.0,4,", "1.0," + cell + ",")));
  EXPECT_THAT(message, HasSubstr("a.csv:4:5: column 'theta': '\\xB0\\x01xxx"));
  EXPECT_LT(message.size(), folder_.string().size() + 200);
}

TEST_F(DatasetBoundary, RefusesTablesBeyondItsLimits) {
  EXPECT_THAT(error_of(read(kDescription, std::string(3 << 20, 'x'))),
              HasSubstr("a.csv:1:1: the line is longer than 1048576 bytes"));
  std::string wide = "t,theta,tau";
  for (int i = 0; i < 5000; ++i) wide += fmt::format(",c{}", i);
  EXPECT_THAT(error_of(read(kDescription, wide + "\n")), HasSubstr("5003 columns, where 4096 are"));
  EXPECT_THAT(error_of(read(kDescription, sound_table() + std::string(3 << 20, '1'))),
              HasSubstr("a.csv:18:1: the line is longer"));
  EXPECT_THAT(error_of(read(kDescription, "t,theta,tau\n")), HasSubstr("a.csv: 0 samples"));
}

TEST_F(DatasetBoundary, TakesACellOfManyQuotesAsText) {
  const std::string quotes(500000, '"');
  EXPECT_THAT(error_of(read(kDescription, with(sound_table(), "1.0,4,", "1.0," + quotes + ","))),
              HasSubstr("a.csv:4:5: column 'theta': '\"\"\"\""));
}

TEST_F(DatasetBoundary, ReadsLinesThatStraddleItsBlocks) {
  const std::string digits(1000, '3');
  const auto table = table_of(
      "t,theta,tau", 2000, [&](int i) { return fmt::format("{},{},0.{}{}", i, i % 9, i, digits); });
  const DatasetReading reading = read(kDescription, table);
  ASSERT_TRUE(reading.set.has_value());
  const Recording& recording = reading.set->recordings[0];
  ASSERT_EQ(recording.time.size(), 2000U);
  for (int i = 0; i < 2000; i += 37) {
    EXPECT_EQ(recording.find(Quantity::transmitted_torque)->at(static_cast<std::size_t>(i)),
              std::stod(fmt::format("0.{}{}", i, digits)));
  }
}

TEST_F(DatasetBoundary, RefusesWhatIsNoFile) {
  put("dataset.toml", kDescription);
  fs::create_directories(folder_ / "a.csv");
  EXPECT_THAT(error_of(read_dataset(folder_)), HasSubstr("file 'a.csv' is not a file"));
  fs::remove(folder_ / "a.csv");
  ASSERT_EQ(mkfifo((folder_ / "a.csv").c_str(), 0600), 0);
  EXPECT_THAT(error_of(read_dataset(folder_)), HasSubstr("file 'a.csv' is not a file"));
  fs::remove(folder_ / "dataset.toml");
  ASSERT_EQ(mkfifo((folder_ / "dataset.toml").c_str(), 0600), 0);
  EXPECT_THAT(error_of(read_dataset(folder_)), HasSubstr("it is no regular file"));
}

TEST_F(DatasetBoundary, RefusesTomlThatNestsDeep) {
  std::string dotted = "a";
  for (int i = 0; i < 50000; ++i) dotted += ".a";
  for (const std::string& deep :
       {dotted + " = 1\n", "[" + dotted + "]\nb = 1\n", "[[" + dotted + "]]\n",
        "a = " + std::string(50000, '[') + std::string(50000, ']') + "\n",
        "a = " + std::string(50000, '{') + "\n"}) {
    EXPECT_THAT(error_of(read("name = \"x\"\n" + deep, sound_table())),
                HasSubstr("line 2 nests deeper than 64 levels"));
  }
  const std::string prose = "note = '''" + dotted + "[[[[''' # " + dotted + "\nname =";
  EXPECT_TRUE(read(with(kDescription, "name =", prose), sound_table()).set.has_value())
      << "dots in strings and remarks nest nothing";
}

TEST_F(DatasetBoundary, RefusesADescriptionThatIsNone) {
  EXPECT_THAT(error_of(read(std::string(5 << 20, '#'), sound_table())),
              HasSubstr("it has 5242880 bytes, where 4194304 are the most"));
}

TEST_F(DatasetBoundary, TakesRecordingsOfVeryDifferentRates) {
  put("b.csv", table_of("t,theta,tau", 40,
                        [](int i) { return fmt::format("{},{},{}", 3600 * i, i % 7, i % 5); }));
  const DatasetReading reading =
      read(kDescription + "[[recording]]\nid = \"b\"\nfile = \"b.csv\"\n", sound_table());
  EXPECT_TRUE(reading.set.has_value());
  EXPECT_THAT(reading.notes, testing::IsEmpty());
}

}  // namespace
}  // namespace flexspline::data
