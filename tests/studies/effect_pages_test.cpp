// docs/effects is what the program writes, page by page.
#include <cstdlib>
#include <filesystem>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "flexspline/core/effect.hpp"
#include "source_dir.hpp"
#include "study_file.hpp"

namespace flexspline::studies {
namespace {

namespace fs = std::filesystem;

const fs::path kCommitted = fs::path(FLEXSPLINE_SOURCE_DIR) / "docs" / "effects";
constexpr const char* kRemedy =
    "; run `flexspline list effects --pages docs/effects` in the repository and commit";

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  if (!fs::exists(folder)) return names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    names.insert(entry.path().filename().string());
  }
  return names;
}

class EffectPages : public testing::Test {
 protected:
  void SetUp() override {
    const auto program = fs::read_symlink("/proc/self/exe").parent_path() / "flexspline";
    if (!exists(program)) GTEST_SKIP() << program << " is not built";
    const std::string line =
        program.string() + " list effects --pages " + written().string() + " > /dev/null";
    ASSERT_EQ(std::system(line.c_str()), 0);
  }
  fs::path written() const { return folder_.path() / "effects"; }

  ScratchFolder folder_;
};

TEST_F(EffectPages, AreOneAnEffectAndAnIndex) {
  std::set<std::string> expected = {"README.md", "figures"};
  for (const EffectRow& row : effects()) expected.insert(std::string(row.id) + ".md");
  EXPECT_EQ(names_in(written()), expected);
}

TEST_F(EffectPages, SayTheEquationItsLimitsAndEveryParameter) {
  for (const EffectRow& row : effects()) {
    const auto page = read_text((written() / (std::string(row.id) + ".md")).string());
    for (const auto said : {std::string_view("\n$$\n"), row.range, row.not_modelled, row.source}) {
      EXPECT_THAT(page, testing::HasSubstr(std::string(said))) << row.id;
    }
    for (const EffectParameter& one : row.parameters) {
      EXPECT_THAT(page, testing::HasSubstr("| `" + std::string(one.name) + "` | "));
    }
  }
}

// Their bytes hang on the last digit of a simulation, so that only their names are compared.
TEST_F(EffectPages, HaveAPictureEach) {
  if (exists(written() / "figures" / "not-drawn.txt")) GTEST_SKIP() << "there is no node";
  EXPECT_EQ(names_in(written() / "figures").size(), effects().size());
  EXPECT_EQ(names_in(kCommitted / "figures"), names_in(written() / "figures")) << kRemedy;
}

TEST_F(EffectPages, AreCommittedAsTheCodeWritesThem) {
  EXPECT_EQ(names_in(kCommitted), names_in(written())) << kCommitted << kRemedy;
  for (const std::string& name : names_in(written())) {
    if (!fs::is_regular_file(kCommitted / name)) continue;
    EXPECT_TRUE(read_text((kCommitted / name).string()) == read_text((written() / name).string()))
        << (kCommitted / name) << " is out of date" << kRemedy;
  }
}

}  // namespace
}  // namespace flexspline::studies
