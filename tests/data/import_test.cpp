#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dataset_fixture.hpp"
#include "flexspline/core/write_file.hpp"
#include "flexspline/data/dataset.hpp"
#include "flexspline/data/import.hpp"
#include "flexspline/data/sanity_codes.hpp"

namespace flexspline::data {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A sine of the motor in degrees and the torque of a spring, with a line of names of its own.
std::string bench_text(const std::string& names, int rows = 200) {
  std::string text = names + "\n";
  for (int i = 0; i < rows; ++i) {
    text += fmt::format("{};{:.4f};{:.3f}\n", 10 * i, 10.0 * std::sin(0.05 * i),
                        4.0 * std::sin(0.05 * i + 0.1));
  }
  return text;
}

std::string all_open(const ImportPlan& plan) {
  std::string text;
  for (const OpenQuestion& one : plan.open) text += one.problem + "; " + one.remedy + "\n";
  return text;
}

std::string all_inferred(const ImportPlan& plan) {
  std::string text;
  for (const Inference& one : plan.inferred) {
    text += fmt::format("{} ({}: {})\n", one.what, name_of(one.certainty), one.evidence);
  }
  return text;
}

class Import : public InFolder {
 protected:
  ImportWish wish(const std::vector<std::string>& files) const {
    ImportWish one;
    for (const std::string& file : files) one.files.push_back(folder_ / file);
    one.name = "bench";
    return one;
  }

  RecordingSet imported(const ImportWish& from) const {
    const auto plan = plan_import(from);
    EXPECT_TRUE(plan) << plan.error().message();
    EXPECT_EQ(all_open(*plan), "");
    const auto written = write_import(*plan, folder_ / "set");
    EXPECT_TRUE(written) << written.error().message();
    const auto reading = read_dataset(folder_ / "set");
    for (const Finding& one : reading.errors) ADD_FAILURE() << one.message();
    return reading.set.value_or(RecordingSet{});
  }
};

TEST_F(Import, MapsByNameAndUnitAndFindsTheRig) {
  put("messung.csv", bench_text("Zeit [ms];Motorwinkel [Grad];Drehmoment [mNm]"));
  ImportWish from = wish({"messung.csv"});
  from.constants["gear_ratio"] = 100;
  const RecordingSet set = imported(from);
  EXPECT_EQ(set.rig, Rig::locked);
  ASSERT_EQ(set.recordings.size(), 1U);
  const Recording& one = set.recordings[0];
  EXPECT_EQ(one.id, "messung");
  ASSERT_EQ(one.time.size(), 200U);
  EXPECT_DOUBLE_EQ(one.time[7], 0.07);
  EXPECT_NEAR(one.find(Quantity::motor_angle)->at(7), std::numbers::pi / 18 * std::sin(0.35), 1e-6);
  EXPECT_NEAR(one.find(Quantity::transmitted_torque)->at(7), 0.004 * std::sin(0.45), 1e-6);
}

TEST_F(Import, AsksForWhatItCannotFindOut) {
  put("a.csv", bench_text("Zeit [ms];Motorwinkel;Drehmoment [mNm]"));
  const auto plan = plan_import(wish({"a.csv"}));
  ASSERT_TRUE(plan);
  EXPECT_THAT(all_open(*plan), HasSubstr("column 2 'Motorwinkel', the motor_angle, has no unit"));
  EXPECT_THAT(all_open(*plan), HasSubstr("--map theta_m=col2:deg"));
  put("b.csv", bench_text("x;y;z"));
  const auto other = plan_import(wish({"b.csv"}));
  ASSERT_TRUE(other);
  EXPECT_THAT(all_open(*other), HasSubstr("--rig"));
  put("c.csv", bench_text("Zeit [ms];Motorwinkel [deg];Drehmoment [mNm]"));
  const auto held = plan_import(wish({"c.csv"}));
  ASSERT_TRUE(held);
  EXPECT_THAT(all_open(*held),
              HasSubstr("the gear ratio cannot be found: the output is held; state it: --ratio N"));
}

TEST_F(Import, TakesWhatIsStated) {
  put("a.csv", bench_text("x;y;z"));
  ImportWish from = wish({"a.csv"});
  from.rig = Rig::locked;
  from.constants["gear_ratio"] = 50;
  for (const char* text : {"tau=col3:Nm", "theta_m=y:-deg", "t=col1:ms"}) {
    const auto choice = parse_column_choice(text);
    ASSERT_TRUE(choice) << choice.error().message();
    from.choices.push_back(*choice);
  }
  const RecordingSet set = imported(from);
  ASSERT_EQ(set.recordings.size(), 1U);
  EXPECT_NEAR(set.recordings[0].find(Quantity::motor_angle)->at(7),
              -std::numbers::pi / 18 * std::sin(0.35), 1e-6);
}

TEST_F(Import, FindsTheUnitOfTimeOnlyWhereOneFits) {
  const auto stepping = [&](const std::string& name, double step) {
    std::string text = "t;theta_m [deg];tau [Nm]\n";
    for (int i = 0; i < 99; ++i) text += fmt::format("{:.6g};{};{}\n", step * i, i % 7, i % 5);
    put(name, text);
    ImportWish from = wish({name});
    from.constants["gear_ratio"] = 50;
    return plan_import(from);
  };
  const auto found = stepping("a.csv", 0.002);  // 500 Hz in s, 500 kHz in ms
  ASSERT_TRUE(found);
  EXPECT_EQ(all_open(*found), "") << all_inferred(*found);
  EXPECT_THAT(
      all_inferred(*found),
      HasSubstr("column 1 't' is the time in s (likely: by its name; of s, ms and us only s"));
  for (const double step : {0.1, 1.0, 10.0}) {  // 10 Hz or 10 kHz; 1 Hz or 1 kHz; 0.1 or 100 Hz
    const auto open = stepping("b.csv", step);
    ASSERT_TRUE(open);
    EXPECT_THAT(all_open(*open), HasSubstr("the time, has no unit; state it: --map t=col1:s"))
        << step;
  }
}

/// Both angles move: the ratio is their slope, and the side is what turns more.
TEST_F(Import, FindsRatioAndSidesFromTwoAngles) {
  std::string text = "t [s],angle 1 [deg],angle 2 [deg],motor torque [Nm]\n";
  for (int i = 0; i < 400; ++i) {
    const double load = 8.0 * std::sin(0.03 * i);
    text += fmt::format("{},{},{},{}\n", 0.01 * i, load, 100.0 * load + 0.4 * std::cos(0.03 * i),
                        std::cos(0.03 * i));
  }
  put("free.csv", text);
  const auto plan = plan_import(wish({"free.csv"}));
  ASSERT_TRUE(plan);
  EXPECT_EQ(all_open(*plan), "");
  EXPECT_EQ(plan->rig, Rig::free);
  EXPECT_DOUBLE_EQ(plan->constants.at("gear_ratio"), 100.0);
  EXPECT_THAT(all_inferred(*plan),
              HasSubstr("column 3 'angle 2' [deg] is the motor_angle in deg (likely"));
  EXPECT_THAT(all_inferred(*plan), HasSubstr("found from the two angles"));
}

TEST_F(Import, IsIdempotent) {
  put("messung.csv", bench_text("Zeit [ms];Motorwinkel [deg];Drehmoment [mNm]"));
  ImportWish from = wish({"messung.csv"});
  from.constants["gear_ratio"] = 100;
  imported(from);
  const auto first = read_file(folder_ / "set/dataset.toml");
  const auto rows = read_file(folder_ / "set/messung.csv");
  imported(from);
  EXPECT_EQ(*read_file(folder_ / "set/dataset.toml"), *first);
  EXPECT_EQ(*read_file(folder_ / "set/messung.csv"), *rows);
}

/// A moving stretch of so many rows from a time, then a rest.
std::string moves_and_rests(const std::vector<double>& starts) {
  std::string text = "t [s];theta_m [deg];tau [Nm]\n";
  for (const double start : starts) {
    for (int i = 0; i < 300; ++i) {
      const bool rests = i >= 200;
      const double angle = rests ? 0.0 : 10.0 * std::sin(0.02 * std::numbers::pi * i);
      text += fmt::format("{:.2f};{:.4f};{:.4f}\n", start + 0.05 * i, angle,
                          0.4 * angle + 0.001 * (i % 3));
    }
  }
  return text;
}

TEST_F(Import, CutsWhereNothingMovesOrTimePauses) {
  put("long.csv", moves_and_rests({0.0, 15.0, 60.0}));
  ImportWish from = wish({"long.csv"});
  from.constants["gear_ratio"] = 50;
  from.split_s = 3.0;
  const RecordingSet set = imported(from);
  ASSERT_EQ(set.recordings.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    const Recording& one = set.recordings[k];
    EXPECT_EQ(one.id, fmt::format("long-{}", k + 1));
    // 10 s of motion, and at most half of split_s of rest on either side.
    EXPECT_NEAR(one.time.back() - one.time.front(), 11.5, 1.7) << one.id;
    EXPECT_DOUBLE_EQ(one.start_s + set.recordings[0].time.front(), one.time.front());
  }
}

TEST_F(Import, LosesNoRowThatMovesAgainBeforeTheRestIsLong) {
  put("one.csv", moves_and_rests({0.0, 15.0}));
  ImportWish from = wish({"one.csv"});
  from.constants["gear_ratio"] = 50;
  from.split_s = 9.0;  // the rest lasts 5 s
  const RecordingSet set = imported(from);
  ASSERT_EQ(set.recordings.size(), 1U);
  EXPECT_EQ(set.recordings[0].time.size(), 600U);
}

TEST_F(Import, RefusesTimeThatFallsUnlessItIsCutThere) {
  put("twice.csv", moves_and_rests({0.0, 0.0}));
  ImportWish from = wish({"twice.csv"});
  from.constants["gear_ratio"] = 50;
  const auto plan = plan_import(from);
  ASSERT_TRUE(plan);
  const auto refused = write_import(*plan, folder_ / "set");
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message(), HasSubstr("time falls from 14.95 to 0 s"));
  EXPECT_THAT(refused.error().message(), HasSubstr("--split SECONDS"));
  from.split_s = 30.0;
  EXPECT_EQ(imported(from).recordings.size(), 2U);
}

TEST_F(Import, SpreadsSamplesOfACoarseClockAndDropsRepeatedRows) {
  std::string text = "t [ms];theta_m [deg];tau [Nm]\n";
  for (int i = 0; i < 100; ++i) {
    const std::string row =
        fmt::format("{};{:.3f};{:.3f}\n", i / 4 * 4, std::sin(0.1 * i), std::cos(0.1 * i));
    text += row;
    if (i == 50) text += row;
  }
  put("coarse.csv", text);
  ImportWish from = wish({"coarse.csv"});
  from.constants["gear_ratio"] = 50;
  const RecordingSet set = imported(from);
  ASSERT_EQ(set.recordings.size(), 1U);
  const auto& time = set.recordings[0].time;
  ASSERT_EQ(time.size(), 100U);
  for (std::size_t i = 0; i < 96; ++i) EXPECT_NEAR(time[i], 1e-3 * static_cast<double>(i), 1e-12);
}

TEST_F(Import, MarksRowsWithAbsentCells) {
  std::string text = bench_text("Zeit [ms];Motorwinkel [deg];Drehmoment [mNm]");
  const auto cell = text.find(";", text.find("\n300;") + 5) + 1;
  text.replace(cell, text.find('\n', cell) - cell, "#NV");
  put("holes.csv", text);
  ImportWish from = wish({"holes.csv"});
  from.constants["gear_ratio"] = 50;
  const RecordingSet set = imported(from);
  ASSERT_EQ(set.recordings.size(), 1U);
  const auto& valid = *set.recordings[0].find(Quantity::valid);
  EXPECT_EQ(valid[30], 0.0);
  EXPECT_EQ(std::ranges::count(valid, 0.0), 1);
}

TEST_F(Import, KeepsFormulasAndPathsOutOfWhatItWrites) {
  put("=cmd|'!A1.csv",
      bench_text("Zeit [ms];Motorwinkel [deg];\"=HYPERLINK(\"\"x\"\") Drehmoment [mNm]\""));
  ImportWish from = wish({"=cmd|'!A1.csv"});
  from.constants["gear_ratio"] = 50;
  const RecordingSet set = imported(from);
  ASSERT_EQ(set.recordings.size(), 1U);
  EXPECT_EQ(set.recordings[0].id, "r_cmd___A1");
  const auto table = read_file(folder_ / "set/r_cmd___A1.csv");
  ASSERT_TRUE(table);
  EXPECT_THAT(*table, testing::StartsWith("t,theta_m,tau\n0,0,"));
}

TEST_F(Import, NoticesAFileThatChangesBetweenLookingAndWriting) {
  put("a.csv", bench_text("Zeit [ms];Motorwinkel [deg];Drehmoment [mNm]"));
  ImportWish from = wish({"a.csv"});
  from.constants["gear_ratio"] = 50;
  const auto plan = plan_import(from);
  ASSERT_TRUE(plan);
  put("a.csv", bench_text("Zeit [ms];Motorwinkel [deg];Drehmoment [mNm]", 250));
  const auto written = write_import(*plan, folder_ / "set");
  ASSERT_FALSE(written);
  EXPECT_THAT(written.error().message(), HasSubstr("a.csv changed while it was imported"));
}

TEST_F(Import, SaysWhichTablesAreOnClocksOfTheirOwn) {
  std::string angle = "Zeit [ms];Motorwinkel [deg]\n";
  std::string torque = "Zeit [ms];Drehmoment [Nm]\n";
  for (int i = 0; i < 100; ++i) {
    angle += fmt::format("{};{:.4f}\n", 2 * i, std::sin(0.05 * i));
    torque += fmt::format("{};{:.4f}\n", 20 * i, std::sin(0.5 * i));
  }
  put("angle.csv", angle), put("torque.csv", torque);
  const auto plan = plan_import(wish({"angle.csv", "torque.csv"}));
  ASSERT_TRUE(plan);
  EXPECT_THAT(all_open(*plan), HasSubstr("angle.csv: column 1 'Zeit'"));
  EXPECT_THAT(all_open(*plan), HasSubstr("torque.csv: column 1 'Zeit'"));
  EXPECT_THAT(all_open(*plan), HasSubstr("export what belongs together on one clock"));
}

TEST_F(Import, JoinsFilesInTheUnitsOfTheFirst) {
  put("a.csv", bench_text("Zeit [ms];Motorwinkel [deg];Drehmoment [mNm]"));
  put("b.csv", bench_text("time_ms;motor_pos_mrad;torque_Nm"));
  ImportWish from = wish({"a.csv", "b.csv"});
  from.constants["gear_ratio"] = 50;
  const RecordingSet set = imported(from);
  ASSERT_EQ(set.recordings.size(), 2U);
  const auto at = [&](std::size_t k, Quantity quantity) {
    return set.recordings[k].find(quantity)->at(9);
  };
  EXPECT_NEAR(at(1, Quantity::motor_angle), 1e-3 * 10.0 * std::sin(0.45), 1e-6);
  EXPECT_NEAR(at(1, Quantity::transmitted_torque), 1e3 * at(0, Quantity::transmitted_torque), 1e-9);
}

TEST_F(Import, RecordsWhatIsAccepted) {
  put("a.csv", bench_text("Zeit [ms];Motorwinkel [deg];Drehmoment [mNm]"));
  ImportWish from = wish({"a.csv"});
  from.constants["gear_ratio"] = 50;
  from.accept = {"torque_sign"};
  EXPECT_THAT(accepted_findings(imported(from)), ElementsAre("torque_sign"));
}

TEST(ColumnChoice, IsRefusedWithTheRemedy) {
  for (const auto& [text, piece] : {std::pair("tau", "has no column"),
                                    {"tua=col1", "did you mean 'tau'?"},
                                    {"tau=col1:Nn", "unknown unit 'Nn'"},
                                    {"q=", "has no column"},
                                    {"theta_m=col2:counts/0", "counts of a turn"}}) {
    const auto choice = parse_column_choice(text);
    ASSERT_FALSE(choice) << text;
    EXPECT_THAT(choice.error().message(), HasSubstr(piece));
  }
  const auto none = parse_column_choice("tau_m=none");
  ASSERT_TRUE(none);
  EXPECT_THAT(none->column, IsEmpty());
}

}  // namespace
}  // namespace flexspline::data
