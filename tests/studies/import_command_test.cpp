#include <algorithm>
#include <chrono>
#include <sstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "command_line.hpp"
#include "flexspline/data/sanity_check.hpp"
#include "source_dir.hpp"

namespace flexspline::studies {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const std::string kSource = FLEXSPLINE_SOURCE_DIR;
const std::string kBenchFile = kSource + "/docs/examples/bench-file/messung_03.csv";

std::string with_all(std::string text, const std::string& piece, const std::string& instead) {
  for (auto at = text.find(piece); at != text.npos; at = text.find(piece, at + instead.size())) {
    text.replace(at, piece.size(), instead);
  }
  return text;
}

class ImportCommand : public CommandLine {
 protected:
  std::string import(const std::string& more) const {
    return "import " + kBenchFile + " --out " + path("set") + " --yes " + more;
  }

  /// The commands of the page with what they print, run as they stand there.
  std::string transcript(std::size_t commands) const {
    const std::string page = read_text(kSource + "/docs/import.md");
    const std::string fence = "```console\n";
    const auto from = page.find(fence) + fence.size();
    std::istringstream lines(page.substr(from, page.find("```", from) - from));
    std::string said;
    for (std::string line; std::getline(lines, line);) {
      const std::string prompt = "$ flexspline ";
      if (!line.starts_with("$")) continue;
      said += line + "\n";
      if (!line.starts_with(prompt) || commands-- == 0) break;
      const std::string real = with_all(with_all(line.substr(prompt.size()), "my-", path("my-")),
                                        "docs/", kSource + "/docs/");
      const Finished done = call(real);
      EXPECT_EQ(done.code, 0) << done.output;
      said += with_all(with_all(done.result, path("my-"), "my-"), kSource + "/docs/", "docs/");
    }
    return said;
  }
};

TEST_F(ImportCommand, DoesWhatThePageShows) {
  const std::string said = transcript(1);
  EXPECT_THAT(read_text(kSource + "/docs/import.md"), HasSubstr(said.substr(0, said.rfind("$ "))));
}

TEST_F(ImportCommand, AsksForTheRatioAndWritesNothing) {
  const Finished done = call(import(""));
  EXPECT_EQ(done.code, 65);
  EXPECT_THAT(
      done.output,
      HasSubstr("open: the gear ratio cannot be found: the output is held; state it: --ratio N"));
  EXPECT_FALSE(exists(folder_.path() / "set"));
}

TEST_F(ImportCommand, PlansOnADryRun) {
  const Finished done = call(import("--ratio 50 --dry-run --json"));
  ASSERT_EQ(done.code, 0) << done.output;
  const json plan = json::parse(done.result);
  EXPECT_EQ(plan.at("rig"), "locked");
  EXPECT_EQ(plan.at("open").size(), 0U);
  EXPECT_FALSE(exists(folder_.path() / "set"));
}

TEST_F(ImportCommand, KeepsWhatAPersonMended) {
  ASSERT_EQ(call(import("--ratio 50 --split 5")).code, 0);
  const std::string file = path("set/dataset.toml");
  const std::string written = read_text(file);
  ASSERT_EQ(call(import("--ratio 50 --split 5")).code, 0);
  EXPECT_EQ(read_text(file), written);
  folder_.write("set/dataset.toml", written + "# mended\n");
  const Finished done = call(import("--ratio 50 --split 5"));
  EXPECT_EQ(done.code, 73);
  EXPECT_THAT(done.output, HasSubstr("was changed since it was imported"));
  EXPECT_EQ(read_text(file), written + "# mended\n");
}

TEST_F(ImportCommand, ChecksWhatItWroteAndTakesWhatIsAccepted) {
  const std::string turned = "--ratio 50 --split 5 --map tau=Drehmoment:-mNm";
  const Finished wrong = call(import(turned));
  EXPECT_EQ(wrong.code, 65);
  EXPECT_THAT(wrong.output, HasSubstr("check_sign"));
  EXPECT_THAT(wrong.output, HasSubstr("--accept torque_sign"));
  EXPECT_EQ(call("validate " + path("set")).code, 65);
  const Finished accepted = call(import(turned + " --accept torque_sign"));
  EXPECT_EQ(accepted.code, 0) << accepted.output;
  const Finished valid = call("validate " + path("set"));
  EXPECT_EQ(valid.code, 0) << valid.output;
  EXPECT_THAT(valid.output, HasSubstr("accepted by the data set"));
}

TEST_F(ImportCommand, RefusesWhatItDoesNotKnow) {
  EXPECT_THAT(call(import("--rig lokced")).output, HasSubstr("did you mean 'locked'?"));
  EXPECT_THAT(call(import("--accept torque_sing")).output,
              HasSubstr("did you mean 'torque_sign'?"));
  EXPECT_EQ(call(import("--ratio -3")).code, 2);
  EXPECT_EQ(call("import " + path("none.csv") + " --out " + path("set")).code, 66);
}

TEST_F(ImportCommand, ListsItsReaders) {
  const Finished done = call("list readers --json");
  ASSERT_EQ(done.code, 0);
  std::vector<std::string> ids;
  for (const json& row : json::parse(done.result)) ids.push_back(row.at("id"));
  EXPECT_THAT(ids,
              testing::ElementsAre("csv", "hdf5", "matlab", "mcap", "mdf4", "netcdf", "rosbag2"));
}

TEST_F(ImportCommand, ListsWhatItsChecksMayAnswer) {
  const Finished done = call("list checks --json");
  ASSERT_EQ(done.code, 0);
  const json rows = json::parse(done.result);
  EXPECT_EQ(rows.size(), data::sanity_checks().size());
  const auto clipped = std::ranges::find(
      rows, "clipped", [](const json& row) { return row.at("id").get<std::string>(); });
  ASSERT_NE(clipped, rows.end());
  EXPECT_EQ(clipped->at("verdicts"), json::parse(R"([{"code": "check_channel", "severity": "error",
    "remedy": "widen the sensor's range, or mark these samples with valid = 0"}])"));
  EXPECT_THAT(call("list checks").result, HasSubstr("check_channel  error    widen the sensor's"));
}

}  // namespace
}  // namespace flexspline::studies
