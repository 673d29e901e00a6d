#include <nlohmann/json.hpp>

#include "program_fixture.hpp"

namespace flexspline::studies {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class VerifyCommand : public Program {
 protected:
  void flip_byte(const std::string& file) const {
    std::string text = read_text(path(file));
    ASSERT_FALSE(text.empty()) << file;
    text[text.size() / 2] = static_cast<char>(text[text.size() / 2] ^ 1);
    folder_.write(file, text);
  }
};

TEST_F(VerifyCommand, FindsEveryFileAsItWasWritten) {
  ASSERT_EQ(run_program({"run", path("study.toml"), "--out", path("out")}).code, 0);
  const Ended ended = run_program({"verify", path("out"), "--jobs", "1"});
  EXPECT_EQ(ended.code, 0) << ended.said;
  EXPECT_THAT(ended.result, HasSubstr("files are as they were written"));
  EXPECT_EQ(run_program({"report", path("out")}).code, 0);
  EXPECT_EQ(run_program({"verify", path("out"), "--jobs", "1"}).code, 0) << "drawn again";
}

TEST_F(VerifyCommand, ReadsAStudyWithAModelFileBack) {
  std::string study = kSmallStudy;
  const std::string method = "method = \"midpoint_polynomial\"";
  study.replace(study.find(method), method.size(),
                "method = \"model_file\"\nmodel = \"model.toml\"");
  folder_.write("study.toml", study);
  ASSERT_EQ(run_program({"run", path("study.toml"), "--out", path("out")}).code, 0);
  const Ended ended = run_program({"verify", path("out"), "--jobs", "1"});
  EXPECT_EQ(ended.code, 0) << ended.said;
  EXPECT_THAT(ended.result, HasSubstr("bitwise"));
}

TEST_F(VerifyCommand, NamesEveryFileThatWasTamperedWith) {
  ASSERT_EQ(simulate("set").code, 0);
  ASSERT_EQ(
      run_program({"fit", path("set"), "--estimator", "midpoint_polynomial", "--out", path("out")})
          .code,
      0);
  for (const char* file : {"out/estimate.json", "out/model.toml", "out/report/index.html",
                           "out/tables/estimators.csv"}) {
    flip_byte(file);
  }
  fs::resize_file(path("out/results.nc"), fs::file_size(path("out/results.nc")) - 1);
  fs::remove(path("out/ro-crate-metadata.json"));
  const Ended ended = run_program({"verify", path("out"), "--jobs", "1"});
  EXPECT_EQ(ended.code, 1) << ended.said;
  EXPECT_THAT(ended.result, HasSubstr("6 are not as they were written"));
  for (const char* file : {"estimate.json", "model.toml", "report/index.html", "results.nc",
                           "tables/estimators.csv", "ro-crate-metadata.json"}) {
    EXPECT_THAT(ended.result, HasSubstr(file));
  }
}

TEST_F(VerifyCommand, ComparesTheDataBeforeItComputes) {
  ASSERT_EQ(run_program({"conceal", path("bench.toml"), "--out", path("one")}).code, 0);
  std::string other = kSmallBench;
  other.replace(other.find("seed = 11"), 9, "seed = 12");
  folder_.write("other.toml", other);
  ASSERT_EQ(run_program({"conceal", path("other.toml"), "--out", path("two")}).code, 0);
  ASSERT_EQ(run_program({"diagnose", path("one/dataset"), "--out", path("diag")}).code, 0);
  const Ended ended =
      run_program({"verify", path("diag"), "--dataset", path("two/dataset"), "--json"});
  EXPECT_EQ(ended.code, 1) << ended.said;
  EXPECT_THAT(ended.result, HasSubstr("The recordings are not those"));
  EXPECT_THAT(ended.result, HasSubstr("datasets/recordings/sha256"));
  EXPECT_THAT(ended.result, Not(HasSubstr("are the same")));
  EXPECT_FALSE(fs::exists(path("diag/verification/again/diagnosis.json"))) << "nothing computed";
}

// Asked for in another way it would be another answer.
TEST_F(VerifyCommand, AsksForADiagnosisAsItWasAskedFor) {
  ASSERT_EQ(run_program({"conceal", path("bench.toml"), "--out", path("one")}).code, 0);
  ASSERT_EQ(run_program({"diagnose", path("one/dataset"), "--out", path("all"), "--quick"}).code,
            0);
  ASSERT_EQ(run_program({"diagnose", path("one/dataset"), "--out", path("large"), "--quick",
                         "--interest", "40%"})
                .code,
            0);
  const auto causes = [&](const char* file) {
    return nlohmann::json::parse(read_text(path(file))).at("causes").size();
  };
  ASSERT_GT(causes("all/diagnosis.json"), causes("large/diagnosis.json"));
  const Ended ended = run_program({"verify", path("large"), "--dataset", path("one/dataset")});
  EXPECT_EQ(ended.code, 0) << ended.result << ended.said;
}

// A data set that was edited since the study ran is another one.
TEST_F(VerifyCommand, ComparesTheDataOfAStudy) {
  ASSERT_EQ(simulate("set").code, 0);
  ASSERT_EQ(
      run_program({"fit", path("set"), "--estimator", "midpoint_polynomial", "--out", path("out")})
          .code,
      0);
  ASSERT_EQ(simulate("set", {"--samples", "400"}).code, 0);
  const Ended ended = run_program({"verify", path("out"), "--jobs", "1"});
  EXPECT_EQ(ended.code, 1);
  EXPECT_THAT(ended.result, HasSubstr("The recordings are not those"));
}

TEST_F(VerifyCommand, RemovesNothingOfAnotherHand) {
  ASSERT_EQ(run_program({"run", path("study.toml"), "--out", path("out")}).code, 0);
  fs::create_directories(path("mine/again"));
  folder_.write("mine/again/thesis.txt", "mine");
  EXPECT_EQ(run_program({"verify", path("out"), "--out", path("mine")}).code, 73);
  EXPECT_EQ(run_program({"verify", path("out"), "--out", path("out")}).code, 73);
  EXPECT_EQ(read_text(path("mine/again/thesis.txt")), "mine");
}

}  // namespace
}  // namespace flexspline::studies
