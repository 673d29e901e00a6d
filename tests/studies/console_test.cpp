#include "program_fixture.hpp"

namespace flexspline::studies {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class SpokenTo : public Program {};

TEST_F(SpokenTo, ItKeepsItsWorkWhereNobodyListens) {
  for (const Stream stream : {Stream::closed, Stream::full}) {
    const std::string out = path(stream == Stream::closed ? "closed" : "full");
    Call call{{"run", path("study.toml"), "-v", "--out", out}};
    call.err = stream;
    const Ended ended = run_program(call);
    EXPECT_EQ(ended.signal, 0);
    EXPECT_EQ(ended.code, 0);
    EXPECT_TRUE(fs::exists(out + "/report/index.html"));
    EXPECT_EQ(read_text(out + "/results.nc").substr(1, 3), "HDF") << "nothing was said into it";
  }
}

TEST_F(SpokenTo, ItSaysThatAResultCouldNotBePrinted) {
  for (const Stream stream : {Stream::closed, Stream::full}) {
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"list", "effects"},
          {"--help"},
          {"--version"},
          {"run", path("study.toml"), "--out", path("out")}}) {
      Call call{words};
      call.out = stream;
      const Ended ended = run_program(call);
      EXPECT_EQ(ended.code, 73) << words.front();
      EXPECT_THAT(ended.said, HasSubstr("cannot be printed"));
      EXPECT_THAT(ended.said, Not(HasSubstr("defect")));
    }
  }
  EXPECT_TRUE(fs::exists(path("out/report/index.html"))) << "the work is kept";
}

TEST_F(SpokenTo, ItOutlivesAReaderThatLeaves) {
  const std::string code = path("code");
  const std::string line =
      "{ sleep 0.3; " + program_path().string() + " list effects; echo $? >" + code + "; } | true";
  ASSERT_EQ(std::system(line.c_str()), 0);
  EXPECT_EQ(read_text(code), "73\n") << "141 would be death by SIGPIPE";
}

TEST_F(SpokenTo, ItRefusesEmptyAndMisspeltArguments) {
  const Ended empty = run_program({"run", path("study.toml"), "--out", ""});
  EXPECT_EQ(empty.code, 2);
  EXPECT_THAT(empty.said, HasSubstr("--out is empty"));
  EXPECT_EQ(run_program({"validate", ""}).code, 2);
  const Ended misspelt = run_program({"run", path("study.toml"), "--outt", path("out")});
  EXPECT_EQ(misspelt.code, 2);
  EXPECT_THAT(misspelt.said, HasSubstr("run has no option '--outt'; did you mean '--out'?"));
}

TEST_F(SpokenTo, ItSaysInItsOwnWordsWhereJsonIsBroken) {
  fs::create_directories(path("diagnosis"));
  folder_.write("diagnosis/diagnosis.json", "{\"schema\": \"flexspline-diagnosis/1\",\n \"a\": }");
  const Ended broken = run_program({"report", path("diagnosis")});
  EXPECT_EQ(broken.code, 65);
  EXPECT_THAT(broken.said, HasSubstr("diagnosis.json: from line 2, column 7 on it is not JSON"));
  EXPECT_THAT(broken.said, Not(HasSubstr("json.exception")));
}

}  // namespace
}  // namespace flexspline::studies
