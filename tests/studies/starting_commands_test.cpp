#include <cmath>
#include <numbers>
#include <regex>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "command_line.hpp"

namespace flexspline::studies {
namespace {

using testing::HasSubstr;

double stated(const std::string& dataset, const char* key, double otherwise) {
  std::smatch found;
  const std::regex line(std::string(key) + " = ([0-9.]+)");
  return std::regex_search(dataset, found, line) ? std::stod(found[1]) : otherwise;
}

/// A sine with what a template's [channels] names: angles on both sides of the gear, and torques
/// that lead them; the free drive's motor turns both inertias.
double value_of(const std::string& quantity, double amplitude, double omega, double t) {
  const double angle = amplitude * std::sin(omega * t);
  const double speed = amplitude * omega * std::cos(omega * t);
  constexpr double kRatio = 50.0;
  if (quantity == "time") return t;
  if (quantity == "motor_angle") return kRatio * angle;
  if (quantity == "motor_torque") {
    const double degree = std::numbers::pi / 180.0;
    return kRatio * degree *
           ((0.726e-3 + 2.9 / kRatio / kRatio) * -omega * omega * angle + 0.01 * speed);
  }
  if (quantity.ends_with("torque") || quantity == "current") return 10.0 * angle + speed / omega;
  return angle;
}

/// A table with the columns that a template names, two periods of its stated sine.
std::string table_for(const std::string& dataset) {
  static const std::regex channel("^(\\w+) = \\{ quantity = \"(\\w+)\"");
  std::vector<std::string> columns;
  std::vector<std::string> quantities;
  std::istringstream lines(dataset);
  for (std::string line; std::getline(lines, line);) {
    std::smatch found;
    if (!std::regex_search(line, found, channel)) continue;
    columns.push_back(found[1]);
    quantities.push_back(found[2]);
  }
  const double amplitude = stated(dataset, "amplitude_deg", 1.0);
  const double frequency = stated(dataset, "frequency_hz", 0.1);
  std::string text = fmt::format("{}\n", fmt::join(columns, ","));
  for (int i = 0; i < 400; ++i) {
    std::vector<std::string> cells;
    for (const std::string& quantity : quantities) {
      cells.push_back(
          fmt::format("{:.9g}", value_of(quantity, amplitude, 2.0 * std::numbers::pi * frequency,
                                         i / (200.0 * frequency))));
    }
    text += fmt::format("{}\n", fmt::join(cells, ","));
  }
  return text;
}

TEST_F(CommandLine, InitWritesAStudyAndABenchThatAreValidAsTheyStand) {
  for (const char* kind : {"study", "bench"}) {
    const Finished done = call(fmt::format("init {} {}", kind, path(kind)));
    ASSERT_EQ(done.code, 0) << done.output;
    EXPECT_EQ(done.result, path(kind) + ".toml\n");
    const Finished check = call("validate " + path(kind) + ".toml");
    EXPECT_EQ(check.code, 0) << check.output;
  }
  EXPECT_THAT(call("plan --list " + path("study.toml")).result,
              HasSubstr("h_even--trajectory--r0"));
}

TEST_F(CommandLine, InitWritesADataSetForEveryRigThatIsValidOnceItsTableIsThere) {
  static const std::regex file("file = \"([^\"]+)\"");
  for (const char* rig : {"locked", "free", "specimen", "servo"}) {
    ASSERT_EQ(call(fmt::format("init rig {} --rig {}", path(rig), rig)).code, 0) << rig;
    const std::string text = read_text(path(rig) + "/dataset.toml");
    std::smatch name;
    ASSERT_TRUE(std::regex_search(text, name, file));
    EXPECT_EQ(call("validate " + path(rig)).code, 65) << "there is no table yet";
    folder_.write(std::string(rig) + "/" + name[1].str(), table_for(text));
    const Finished check = call("validate " + path(rig));
    EXPECT_EQ(check.code, 0) << rig << ": " << check.output;
  }
}

TEST_F(CommandLine, InitNeverOverwritesAndNamesTheTemplatesThereAre) {
  folder_.write("mine.toml", "precious");
  const Finished done = call("init study " + path("mine.toml"));
  EXPECT_EQ(done.code, 73);
  EXPECT_THAT(done.output, HasSubstr("mine.toml is there already"));
  EXPECT_EQ(read_text(path("mine.toml")), "precious");
  const Finished unknown = call("init studdy " + path("x"));
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.output, HasSubstr("did you mean 'study'?"));
  EXPECT_EQ(call("init rig " + path("x") + " --rig lockd").code, 2);
}

TEST_F(CommandLine, ExplainPrintsAnEffectsPageOrTheNearestName) {
  const Finished done = call("explain backlash");
  EXPECT_EQ(done.code, 0);
  for (const char* words : {"# backlash", "phi_e = phi", "`half_gap`", "## Source"}) {
    EXPECT_THAT(done.result, HasSubstr(words));
  }
  EXPECT_THAT(done.result, testing::Not(HasSubstr("<!--")));
  EXPECT_EQ(nlohmann::json::parse(call("explain backlash --json").result)["id"], "backlash");
  const Finished unknown = call("explain backlsh");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.output, HasSubstr("did you mean 'backlash'?"));
}

TEST_F(CommandLine, ManualHasEveryCommandAndWhatItPrintsIsRoff) {
  const Finished done = call("manual");
  EXPECT_EQ(done.code, 0);
  EXPECT_TRUE(done.result.starts_with(".TH FLEXSPLINE 1"));
  const std::string help = call("--help").result;
  const auto commands = nlohmann::json::parse(call("list commands --json").result);
  for (const auto& command : commands) {
    const std::string name = command["id"];
    EXPECT_THAT(done.result, HasSubstr(".SS \"" + name + "\""));
    EXPECT_THAT(help, HasSubstr("\n  " + name));
  }
  EXPECT_GT(commands.size(), 15U);
}

TEST_F(CommandLine, DoctorFitsCertifiedProblemsAndFindsTheSolversGood) {
  const Finished done = call("doctor --json");
  EXPECT_EQ(done.code, 0) << done.output;
  const auto checks = nlohmann::json::parse(done.result);
  EXPECT_EQ(checks.back()["check"], "solvers");
  EXPECT_EQ(checks.back()["health"], "good");
  EXPECT_THAT(checks.front()["found"].get<std::string>(), HasSubstr("Ceres"));
  const auto memory = std::ranges::find(checks, "memory", [](const auto& c) { return c["check"]; });
  ASSERT_NE(memory, checks.end());
  double all = 0.0;
  double available = 0.0;
  const std::string found = (*memory)["found"];
  ASSERT_EQ(std::sscanf(found.c_str(), "%lf GiB, of which %lf can", &all, &available), 2) << found;
  EXPECT_GT(available, 0.0);
  EXPECT_GE(all, available);
  EXPECT_THAT(found, HasSubstr("a diagnosis takes"));
}

}  // namespace
}  // namespace flexspline::studies
