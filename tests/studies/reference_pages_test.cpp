// docs/reference is what the program writes.
#include "program_fixture.hpp"

namespace flexspline::studies {
namespace {

using testing::HasSubstr;

const std::filesystem::path kReference =
    std::filesystem::path(FLEXSPLINE_SOURCE_DIR) / "docs" / "reference";

std::set<std::string> pages_in(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    names.insert(entry.path().filename().string());
  }
  return names;
}

class ReferencePages : public Program {};

TEST_F(ReferencePages, AreCommittedAsTheCodeWritesThem) {
  ASSERT_EQ(run_program({"list", "reference", "--pages", path("reference")}).code, 0);
  const auto written = pages_in(path("reference"));
  EXPECT_EQ(pages_in(kReference), written);
  for (const std::string& name : written) {
    EXPECT_TRUE(read_text(kReference / name) == read_text(path("reference/" + name)))
        << name
        << " is out of date; run `flexspline list reference --pages docs/reference` and commit";
  }
}

TEST_F(ReferencePages, HaveEveryCommandAndEveryKey) {
  const std::string commands = read_text(kReference / "commands.md");
  for (const char* said : {"## diagnose", "| `--holdout` |", "## export-case"}) {
    EXPECT_THAT(commands, HasSubstr(said));
  }
  const std::string formats = read_text(kReference / "formats.md");
  for (const char* key :
       {"| `constants.gear_ratio` |", "| `estimator[].method` |", "| `origin` |"}) {
    EXPECT_THAT(formats, HasSubstr(key));
  }
}

TEST_F(ReferencePages, ReplaceNoOtherFile) {
  std::filesystem::create_directory(path("mine"));
  folder_.write("mine/laws.md", "my own\n");
  const Ended ended = run_program({"list", "reference", "--pages", path("mine")});
  EXPECT_EQ(ended.code, 73) << ended.said;
  EXPECT_EQ(read_text(path("mine/laws.md")), "my own\n");
}

}  // namespace
}  // namespace flexspline::studies
