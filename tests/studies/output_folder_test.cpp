#include "program_fixture.hpp"

namespace flexspline::studies {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class OutputFolderOfACommand : public Program {
 protected:
  /// What is refused is named, and nothing is touched.
  void expect_refused(const std::vector<std::string>& words, const std::string& names) const {
    const auto before = hashes(folder_.path());
    const Ended ended = run_program(words);
    EXPECT_EQ(ended.code, 73) << ended.said;
    EXPECT_THAT(ended.said, HasSubstr(names));
    EXPECT_EQ(hashes(folder_.path()), before) << "nothing is written";
  }
};

TEST_F(OutputFolderOfACommand, IsNeverAnInput) {
  ASSERT_EQ(simulate("set").code, 0);
  const std::string set = path("set");
  for (const std::string& out : {set, set + "/inside", path(""), set + "/../set/./"}) {
    for (const char* force : {"--force", "--quiet"}) {
      expect_refused({"simulate", path("model.toml"), "--like", set, "--out", out, force},
                     "the input");
      expect_refused({"diagnose", set, "--out", out, force}, "the input");
    }
  }
}

TEST_F(OutputFolderOfACommand, IsNeverAnInputBehindALink) {
  ASSERT_EQ(simulate("set").code, 0);
  fs::create_directory_symlink(path("set"), path("link"));
  expect_refused({"diagnose", path("set"), "--out", path("link"), "--force"}, "the input");
  expect_refused({"diagnose", path("link"), "--out", path("set"), "--force"}, "the input");
  fs::create_directories(path("out"));
  fs::create_directory_symlink(path("set"), path("out/tables"));
  expect_refused({"diagnose", path("set"), "--out", path("out"), "--force"}, "the input");
}

TEST_F(OutputFolderOfACommand, OfAnotherHandIsRefusedAndNamed) {
  fs::create_directories(path("mine"));
  folder_.write("mine/dataset.toml", "mine");
  folder_.write("mine/notes.txt", "mine");
  expect_refused({"simulate", path("model.toml"), "--excitation", "sine", "--amplitude", "0.2deg",
                  "--frequency", "0.005Hz", "--out", path("mine")},
                 "dataset.toml, notes.txt");
  expect_refused({"conceal", path("bench.toml"), "--out", path("mine")}, "notes.txt");
  expect_refused({"run", path("study.toml"), "--out", path("mine")}, "notes.txt");
}

TEST_F(OutputFolderOfACommand, ForcedReplacesWhatItWritesItselfAndNothingElse) {
  fs::create_directories(path("mine"));
  folder_.write("mine/dataset.toml", "mine");
  folder_.write("mine/notes.txt", "mine");
  ASSERT_EQ(simulate("mine", {"--force"}).code, 0);
  EXPECT_EQ(read_text(path("mine/notes.txt")), "mine");
  EXPECT_EQ(run_program({"validate", path("mine")}).code, 0);
}

TEST_F(OutputFolderOfACommand, IsWrittenAgainFromTheSameThing) {
  ASSERT_EQ(simulate("set").code, 0);
  EXPECT_EQ(simulate("set").code, 0);
  std::ofstream(path("model.toml"), std::ios::app) << "# edited in its place\n";
  EXPECT_EQ(simulate("set").code, 0);
  folder_.write("other.toml", read_text(path("model.toml")) + "# another\n");
  expect_refused({"simulate", path("other.toml"), "--excitation", "sine", "--amplitude", "0.2deg",
                  "--frequency", "0.005Hz", "--out", path("set")},
                 "holds what simulate wrote of 'model.toml', not simulate of 'other.toml'");
}

TEST_F(OutputFolderOfACommand, KeepsACommitmentThatWasShown) {
  const std::vector<std::string> conceal = {"conceal", path("bench.toml"), "--out", path("old")};
  ASSERT_EQ(run_program(conceal).code, 0);
  const auto before = hashes(path("old"));
  EXPECT_EQ(run_program(conceal).code, 0);
  EXPECT_EQ(hashes(path("old")), before) << "the same salt, the same answer";
  std::ofstream(path("bench.toml"), std::ios::app) << "# another effect, perhaps\n";
  expect_refused(conceal, "holds what conceal wrote");
}

TEST_F(OutputFolderOfACommand, OfAStudyBelongsToThatStudy) {
  ASSERT_EQ(run_program({"run", path("study.toml"), "--out", path("paper")}).code, 0);
  std::string other = kSmallStudy;
  other.replace(other.find("\"small\""), 7, "\"other\"");
  folder_.write("other.toml", other);
  expect_refused({"run", path("other.toml"), "--out", path("paper")},
                 "holds what run wrote of 'small', not run of 'other'");
  expect_refused({"conceal", path("bench.toml"), "--out", path("paper")}, "holds what run wrote");
  const Ended again = run_program({"run", path("study.toml"), "--json", "--out", path("paper")});
  EXPECT_THAT(again.result, HasSubstr("\"reused\": 1"));
  ASSERT_EQ(run_program({"conceal", path("bench.toml"), "--out", path("hidden")}).code, 0);
  expect_refused({"run", path("study.toml"), "--out", path("hidden")}, "holds what conceal wrote");
}

// What cannot be written is said before the work, and nothing is left of a command that failed.
TEST_F(OutputFolderOfACommand, IsMadeBeforeTheWorkAndTakenAwayWhereNothingCameOfIt) {
  ASSERT_EQ(run_program({"conceal", path("bench.toml"), "--out", path("hidden")}).code, 0);
  const Ended ended =
      run_program({"diagnose", path("hidden/dataset"), "-v", "--out", "/proc/nowhere/out"});
  EXPECT_EQ(ended.code, 73) << ended.said;
  EXPECT_THAT(ended.said, Not(HasSubstr(" %  "))) << "no stage of the diagnosis began";
  EXPECT_EQ(run_program({"diagnose", path("model.toml"), "--out", path("a/b")}).code, 66);
  EXPECT_EQ(simulate("c/d", {"--direction", "torsion"}).code, 2);
  EXPECT_FALSE(fs::exists(path("a")));
  EXPECT_FALSE(fs::exists(path("c")));
}

TEST_F(OutputFolderOfACommand, OfPagesKeepsFilesThatAreNone) {
  ASSERT_EQ(run_program({"list", "effects", "--pages", path("pages")}).code, 0);
  EXPECT_EQ(run_program({"list", "effects", "--pages", path("pages")}).code, 0);
  folder_.write("pages/backlash.md", "mine");
  expect_refused({"list", "effects", "--pages", path("pages")}, "backlash.md");
}

}  // namespace
}  // namespace flexspline::studies
