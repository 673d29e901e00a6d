#include <array>
#include <cstdio>

#include <sys/wait.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "flexspline/data/artefact.hpp"
#include "flexspline/studies/diagnosis_json.hpp"
#include "study_file.hpp"

namespace flexspline::studies {
namespace {

struct Finished {
  int code = -1;
  std::string result;  ///< stdout
};

/// The program on a bench that hides an offset of the torque sensor.
class DiagnoseCommand : public testing::Test {
 protected:
  void SetUp() override {
    program_ = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "flexspline";
    if (!exists(program_)) GTEST_SKIP() << program_ << " is not built";
    folder_.write("bench.toml",
                  "schema = \"flexspline-bench/1\"\nrig = \"locked\"\nseed = 11\n"
                  "effects = [{ id = \"torque_sensor_offset\", size_fraction = 0.08 }]\n");
    ASSERT_EQ(call("conceal " + path("bench.toml") + " --out " + path("hidden")).code, 0);
  }
  Finished call(const std::string& arguments) const {
    const std::string line = program_.string() + " " + arguments + " 2>/dev/null";
    Finished finished;
    FILE* pipe = popen(line.c_str(), "r");
    std::array<char, 4096> buffer{};
    while (const std::size_t size = fread(buffer.data(), 1, buffer.size(), pipe)) {
      finished.result.append(buffer.data(), size);
    }
    finished.code = WEXITSTATUS(pclose(pipe));
    return finished;
  }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  Finished diagnose(const std::string& options = "") const {
    return call("diagnose " + path("hidden/dataset") + " --out " + path("out") + options);
  }

  ScratchFolder folder_;
  std::filesystem::path program_;
};

TEST_F(DiagnoseCommand, ExitsWith0AndPrintsWhatTheArtefactSays) {
  const Finished done = diagnose(" --json");
  ASSERT_EQ(done.code, 0);
  const auto printed = nlohmann::ordered_json::parse(done.result);
  const auto written = data::read_artefact(path("out/diagnosis.json"), kDiagnosisSchema);
  ASSERT_TRUE(written) << written.error().message();
  EXPECT_EQ(printed, *written);
  EXPECT_EQ(printed.at("dataset").at("sha256").get<std::string>().size(), 64u);
}

TEST_F(DiagnoseCommand, NamesNothingBelowWhatInterests) {
  const auto causes = [&](const std::string& options) {
    const Finished done = diagnose(" --quick --json" + options);
    EXPECT_EQ(done.code, 0);
    return nlohmann::json::parse(done.result).at("causes").size();
  };
  EXPECT_EQ(causes(""), 1U);
  EXPECT_EQ(causes(" --interest 20%"), 0U);
  EXPECT_EQ(diagnose(" --interest 200%").code, 2);
  EXPECT_EQ(diagnose(" --interest '1 Nm'").code, 2);
}

TEST_F(DiagnoseCommand, TheSameRecordingsGiveTheSameBytes) {
  const std::vector<std::string> files = {"diagnosis.json", "index.html", "report/report.json"};
  ASSERT_EQ(diagnose().code, 0);
  std::vector<std::string> first;
  for (const std::string& file : files) first.push_back(read_text(path("out/" + file)));
  ASSERT_EQ(diagnose().code, 0);
  for (std::size_t i = 0; i < files.size(); ++i) {
    EXPECT_TRUE(read_text(path("out/" + files[i])) == first[i]) << files[i];
  }
}

TEST_F(DiagnoseCommand, ItsPageIsDrawnAgainFromTheArtefactAloneToTheSameBytes) {
  ASSERT_EQ(diagnose().code, 0);
  std::filesystem::create_directories(path("moved"));
  std::filesystem::copy_file(path("out/diagnosis.json"), path("moved/diagnosis.json"));
  ASSERT_EQ(call("report " + path("moved")).code, 0);
  EXPECT_TRUE(read_text(path("out/index.html")) == read_text(path("moved/index.html")));
  EXPECT_TRUE(read_text(path("out/report/report.json")) ==
              read_text(path("moved/report/report.json")));
}

TEST_F(DiagnoseCommand, LeavesNoModelOfAnEarlierRun) {
  ASSERT_EQ(diagnose().code, 0);
  folder_.write("out/model.toml", "stale");
  ASSERT_EQ(diagnose().code, 0);
  EXPECT_NE(read_text(path("out/model.toml")), "stale");
}

TEST_F(DiagnoseCommand, RefusesWhatIsNotThereAndWhatCannotBeUsed) {
  EXPECT_EQ(call("diagnose " + path("nowhere") + " --out " + path("out")).code, 66);
  std::filesystem::create_directories(path("broken"));
  folder_.write("broken/dataset.toml", "schema = \"flexspline-dataset/1\"\n");
  EXPECT_EQ(call("diagnose " + path("broken") + " --out " + path("out")).code, 65);
  EXPECT_FALSE(std::filesystem::exists(path("out")));
}

}  // namespace
}  // namespace flexspline::studies
